! rule: a pos is divided by a num, nothing by a pos
! source: [backup] programs of a running cell with RobotWare 6.16; [K §3.11] has no such operator
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        p := (p + p) / 2;
        p := p / n;
        p := n / p;  ! -> RG308
        p := p / p;  ! -> RG308
    ENDPROC
ENDMODULE
