! rule: a sign stands at the start of a sum
! source: [K §3] [code] 0 uses elsewhere
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n * -n;  ! -> RG212?
        n := n + -n;  ! -> RG212?
        n := n * (-n);
    ENDPROC
ENDMODULE
