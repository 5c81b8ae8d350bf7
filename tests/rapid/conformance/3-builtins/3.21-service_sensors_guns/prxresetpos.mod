! rule: arguments of PrxResetPos
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxResetPos v_mecunit;
        PrxResetPos;  ! -> RG311?
    ENDPROC
ENDMODULE
