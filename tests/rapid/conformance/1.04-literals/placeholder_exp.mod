! rule: <EXP> stands for an expression
! source: [K §2.9, 3]
MODULE Demo
    VAR num a;
    PROC main()
        a := <EXP>;
    ENDPROC
ENDMODULE
