! rule: ERROR comes before UNDO
! source: [K §5.3]
MODULE Demo
    PROC main()
    UNDO
        TPErase;
    ERROR  ! -> RG216
        TRYNEXT;
    ENDPROC
ENDMODULE
