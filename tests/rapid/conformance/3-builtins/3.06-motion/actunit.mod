! rule: arguments of ActUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        ActUnit v_mecunit;
        ActUnit;  ! -> RG311?
        ActUnit v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
