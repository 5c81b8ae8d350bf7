! rule: a signal is read as num
! source: [K §2.16, 2.17]
MODULE Demo
    VAR num a;
    VAR signaldi di1;
    PROC main()
        IF di1 = 1 a := di1 + 1;
    ENDPROC
ENDMODULE
