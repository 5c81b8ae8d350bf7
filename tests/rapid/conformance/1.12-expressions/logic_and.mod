! rule: AND, OR, XOR and NOT take bool
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
        b := b AND n;  ! -> RG307
    ENDPROC
ENDMODULE
