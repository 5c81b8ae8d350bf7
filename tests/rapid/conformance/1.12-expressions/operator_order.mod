! rule: operands of order
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := n < n;
        b := n <= n;
        b := n > n;
        b := n >= n;
        b := d < d;
    ENDPROC
ENDMODULE
