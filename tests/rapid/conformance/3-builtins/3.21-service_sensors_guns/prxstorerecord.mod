! rule: arguments of PrxStoreRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        PrxStoreRecord v_mecunit, v_num, v_string;
        PrxStoreRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
