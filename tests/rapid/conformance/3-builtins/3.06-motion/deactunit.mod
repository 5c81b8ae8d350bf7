! rule: arguments of DeactUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        DeactUnit v_mecunit;
        DeactUnit;  ! -> RG311?
        DeactUnit v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
