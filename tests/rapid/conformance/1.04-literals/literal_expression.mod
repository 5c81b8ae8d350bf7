! rule: a PERS starts from literals with signs and aggregates
! source: [K §3.2]
MODULE Demo
    PERS num a := -1;
    PERS pos p := [1, -2, +3];
    VAR num b;
    VAR pos q;
    PROC main()
        b := a;
        q := p;
    ENDPROC
ENDMODULE
