! rule: an IN parameter takes any expression and may be assigned
! source: [K §5.1]
MODULE Demo
    PROC main()
        p 1 + 2;
    ENDPROC
    PROC p(num a)
        a := a + 1;
    ENDPROC
ENDMODULE
