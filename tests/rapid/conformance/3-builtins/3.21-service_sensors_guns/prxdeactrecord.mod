! rule: arguments of PrxDeactRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxDeactRecord v_mecunit;
        PrxDeactRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
