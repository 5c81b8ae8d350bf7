! rule: no persistent in a constant expression
! source: [K §3.1]
MODULE Demo
    PERS num a := 1;
    VAR num b := a;  ! -> RG317
    PROC main()
        TPWrite "" \Num:=b;
    ENDPROC
ENDMODULE
