! rule: arguments of PrxDbgStoreRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR string v_string;
    PROC main()
        PrxDbgStoreRecord v_mecunit, v_string;
        PrxDbgStoreRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
