! rule: a routine has constants
! source: [K §2.18]
MODULE Demo
    PROC main()
        CONST num a := 1;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
