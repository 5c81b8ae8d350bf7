! rule: NOT stands at the start of an expression
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
        b := b AND NOT b;  ! -> RG212?
        b := b AND (NOT b);
    ENDPROC
ENDMODULE
