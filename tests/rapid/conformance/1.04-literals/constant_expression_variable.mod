! rule: no variable in a constant expression
! source: [K §3.1]
MODULE Demo
    VAR num a;
    VAR num b := a + 1;  ! -> RG317
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
