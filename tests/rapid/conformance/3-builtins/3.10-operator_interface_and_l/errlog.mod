! rule: arguments of ErrLog
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrLog 1, "x", "x", "x", "x", "x";
        ErrLog 1 \W, "x", "x", "x", "x", "x";
        ErrLog 1 \I, "x", "x", "x", "x", "x";
        ErrLog 1, "x", "x", "x", "x";  ! -> RG311
        ErrLog 1, "x", "x", "x", "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
