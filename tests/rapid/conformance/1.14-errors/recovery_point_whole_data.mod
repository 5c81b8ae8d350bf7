! rule: the numbers behind ERROR are literals and whole data
! source: [K §7.2]
MODULE Demo
    CONST errnum MY_ERRORS{2} := [17, 18];
    PROC element()
        TPErase;
    ERROR (MY_ERRORS{1})  ! -> RG201
        TRYNEXT;
    ENDPROC
    PROC expression()
        TPErase;
    ERROR (17 + 1)  ! -> RG201
        TRYNEXT;
    ENDPROC
    PROC main()
        TPErase;
    ERROR (17, ERR_DIVZERO)
        TRYNEXT;
    ENDPROC
ENDMODULE
