! rule: arguments of PrxStopRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxStopRecord v_mecunit;
        PrxStopRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
