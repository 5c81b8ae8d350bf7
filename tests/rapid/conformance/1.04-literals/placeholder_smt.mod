! rule: <SMT> stands for a statement, also in a compact IF
! source: [K §2.9, 4]
MODULE Demo
    VAR num a;
    PROC main()
        <SMT>
        IF a = 1 <SMT>
    ENDPROC
ENDMODULE
