! rule: arguments of SupSyncSensorOff
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        SupSyncSensorOff v_mecunit;
        SupSyncSensorOff;  ! -> RG311?
    ENDPROC
ENDMODULE
