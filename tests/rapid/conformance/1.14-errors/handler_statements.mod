! rule: RETRY, TRYNEXT, RETURN and RAISE in a handler
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        TEST ERRNO
        CASE 1:
            RETRY;
        CASE 2:
            TRYNEXT;
        CASE 3:
            RETURN;
        DEFAULT:
            RAISE;
        ENDTEST
    ENDPROC
ENDMODULE
