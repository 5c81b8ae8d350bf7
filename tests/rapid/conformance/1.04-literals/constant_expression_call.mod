! rule: no call in a constant expression, at any depth
! source: [K §3.1]
MODULE Demo
    VAR pos b := [1, 2 * Sin(1), 3];  ! -> RG317
    PROC main()
        TPWrite "" \Pos:=b;
    ENDPROC
ENDMODULE
