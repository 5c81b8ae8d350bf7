! rule: arguments of ErrWrite
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrWrite "x", "x";
        ErrWrite \W, "x", "x" \RL2:="x" \RL3:="x" \RL4:="x";
        ErrWrite \I, "x", "x" \RL2:="x" \RL3:="x" \RL4:="x";
        ErrWrite "x";  ! -> RG311
        ErrWrite "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
