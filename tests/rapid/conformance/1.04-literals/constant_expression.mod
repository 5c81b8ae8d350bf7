! rule: a constant expression has constants and operators
! source: [K §3.1]
MODULE Demo
    CONST num a := 2 * pi;
    VAR num b := a + 1;
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
