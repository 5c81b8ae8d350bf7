! rule: operands of logic
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
        b := b AND b;
        b := b OR b;
        b := b XOR b;
        b := NOT b;
    ENDPROC
ENDMODULE
