! rule: arguments of ErrRaise
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrRaise "x", 1, "x", "x", "x", "x", "x";
        ErrRaise "x", 1, "x", "x", "x", "x";  ! -> RG311
        ErrRaise "x", 1, "x", "x", "x", "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
