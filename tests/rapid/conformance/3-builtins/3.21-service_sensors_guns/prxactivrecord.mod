! rule: arguments of PrxActivRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxActivRecord v_mecunit, v_num;
        PrxActivRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
