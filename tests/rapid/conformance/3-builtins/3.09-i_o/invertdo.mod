! rule: arguments of InvertDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        InvertDO v_signaldo;
        InvertDO;  ! -> RG311?
        InvertDO v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
