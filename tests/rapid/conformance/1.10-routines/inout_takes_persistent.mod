! rule: a persistent as argument of a INOUT parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p s;
    ENDPROC
    PROC p(INOUT num a)
        a := a;
    ENDPROC
ENDMODULE
