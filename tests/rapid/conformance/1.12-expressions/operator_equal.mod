! rule: operands of equal
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
        b := n = n;
        b := s <> s;
        b := p = p;
        b := f <> f;
        b := b = b;
    ENDPROC
ENDMODULE
