! rule: arguments of PrxStartRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxStartRecord v_mecunit, v_num, v_num;
        PrxStartRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
