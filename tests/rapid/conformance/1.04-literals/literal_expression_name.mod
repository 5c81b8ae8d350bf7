! rule: a literal expression has no names, operators or calls
! source: [K §3.2]
MODULE Demo
    CONST num c := 1;
    PERS num a := c;  ! -> RG317
    VAR num b;
    PROC main()
        b := a;
    ENDPROC
ENDMODULE
