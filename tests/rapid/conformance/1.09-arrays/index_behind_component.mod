! rule: only a whole datum has indices
! source: [K §3.5]
MODULE Demo
    VAR num a;
    VAR pos p;
    PROC main()
        a := p.x{1};  ! -> RG201
    ENDPROC
ENDMODULE
