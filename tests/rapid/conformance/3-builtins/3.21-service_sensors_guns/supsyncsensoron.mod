! rule: arguments of SupSyncSensorOn
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        SupSyncSensorOn v_mecunit, v_num, v_num, v_num;
        SupSyncSensorOn v_mecunit, v_num, v_num, v_num \SafetyDelay:=v_num;
        SupSyncSensorOn;  ! -> RG311?
    ENDPROC
ENDMODULE
