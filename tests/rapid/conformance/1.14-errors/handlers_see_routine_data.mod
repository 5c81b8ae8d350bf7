! rule: handlers see the data of their routine
! source: [K §6.1, 7.1]
MODULE Demo
    PROC main()
        VAR num a;
        a := 1;
    ERROR
        TPWrite "" \Num:=a;
        RETRY;
    ENDPROC
ENDMODULE
