! rule: a element as argument of a VAR parameter
! source: [K §5.1]
MODULE Demo
    CONST num c := 1;
    VAR num v;
    VAR num e{2};
    VAR pos q;
    PERS num s := 1;
    PROC main()
        p e{1};
    ENDPROC
    PROC p(VAR num a)
        a := a;
    ENDPROC
ENDMODULE
