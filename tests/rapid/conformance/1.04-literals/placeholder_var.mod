! rule: <VAR> stands for a datum
! source: [K §2.9, 4.4]
MODULE Demo
    PROC main()
        <VAR> := 1;
    ENDPROC
ENDMODULE
