! rule: <CSE> stands for a CASE branch
! source: [K §2.9, 4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        <CSE>
        DEFAULT:
        ENDTEST
    ENDPROC
ENDMODULE
