! rule: an aggregate has the type of the other operand
! source: [K §3.9]
MODULE Demo
    VAR bool a;
    VAR pos p;
    PROC main()
        a := p = [1, 2, 3];
        p := p + [0, 0, 1];
    ENDPROC
ENDMODULE
