! rule: operands that no operator takes: order_pos
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
        b := p < p;  ! -> RG308
    ENDPROC
ENDMODULE
