! rule: operands that no operator takes: unary
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
        s := -s;  ! -> RG308
    ENDPROC
ENDMODULE
