! rule: ERROR with a list of numbers
! source: [K §7.2] [code] open_abb
MODULE Demo
    CONST errnum MY_ERROR := 17;
    PROC main()
        TPErase;
    ERROR (MY_ERROR, 18, LONG_JMP_ALL_ERR)
        TRYNEXT;
    ENDPROC
ENDMODULE
