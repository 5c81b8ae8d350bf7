! rule: BACKWARD, ERROR, UNDO in this order
! source: [K §5.3]
MODULE Demo
    PROC main()
        TPErase;
    BACKWARD
        TPErase;
    ERROR
        TRYNEXT;
    UNDO
        TPErase;
    ENDPROC
ENDMODULE
