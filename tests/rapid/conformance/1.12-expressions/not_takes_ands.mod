! rule: NOT takes everything up to OR or XOR
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
        b := NOT n = 1;
        b := NOT b AND b OR b;
    ENDPROC
ENDMODULE
