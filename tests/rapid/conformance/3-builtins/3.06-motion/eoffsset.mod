! rule: arguments of EOffsSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR extjoint v_extjoint;
    PROC main()
        EOffsSet v_extjoint;
        EOffsSet;  ! -> RG311?
        EOffsSet v_extjoint \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
