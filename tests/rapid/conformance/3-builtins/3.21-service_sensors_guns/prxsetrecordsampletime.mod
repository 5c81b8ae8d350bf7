! rule: arguments of PrxSetRecordSampleTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetRecordSampleTime v_mecunit, v_num;
        PrxSetRecordSampleTime;  ! -> RG311?
    ENDPROC
ENDMODULE
