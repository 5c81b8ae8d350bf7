! rule: operands of plus
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
        n := n + n;
        p := p + p;
        s := s + s;
        d := d + d;
    ENDPROC
ENDMODULE
