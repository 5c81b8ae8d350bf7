! rule: a relation takes part once a level
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
        b := n < n < n;  ! -> RG201
    ENDPROC
ENDMODULE
