! rule: arguments of Set
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        Set v_signaldo;
        Set;  ! -> RG311?
        Set v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
