! rule: <ID> does not stand for a component
! source: [K §3.5]
MODULE Demo
    VAR num a;
    VAR pos p;
    PROC main()
        a := p.<ID>;  ! -> RG201
    ENDPROC
ENDMODULE
