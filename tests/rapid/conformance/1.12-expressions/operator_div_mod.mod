! rule: operands of div_mod
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
        n := n DIV n;
        n := n MOD n;
    ENDPROC
ENDMODULE
