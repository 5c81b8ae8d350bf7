! rule: arguments of PrxResetRecords
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxResetRecords v_mecunit;
        PrxResetRecords;  ! -> RG311?
    ENDPROC
ENDMODULE
