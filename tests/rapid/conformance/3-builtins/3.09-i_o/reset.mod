! rule: arguments of Reset
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        Reset v_signaldo;
        Reset;  ! -> RG311?
        Reset v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
