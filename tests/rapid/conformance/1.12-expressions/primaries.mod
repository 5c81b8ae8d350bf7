! rule: literal, datum, call, aggregate, parentheses
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := 1;
        n := n;
        n := Abs(n);
        p := [1, 2, 3];
        n := (n);
    ENDPROC
ENDMODULE
