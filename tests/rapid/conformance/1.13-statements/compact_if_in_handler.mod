! rule: RETRY and TRYNEXT in a compact IF
! source: [K §4.14]
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        IF ERRNO = 1 RETRY;
        IF ERRNO = 2 TRYNEXT;
    ENDPROC
ENDMODULE
