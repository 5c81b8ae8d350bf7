! rule: data come before statements
! source: [K §5.3]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1;
        VAR num c;  ! -> RG213
        c := a;
        b := c;
    ENDPROC
ENDMODULE
