! rule: operands that no operator takes: pose_times
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
        f := f * f;  ! -> RG308
    ENDPROC
ENDMODULE
