! rule: names of errors: interrupts
! source: [code] rapid-for-vim; [K §12]
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_ALRDYCNT;
        e := ERR_CNTNOTVAR;
        e := ERR_INOMAX;
        e := ERR_UNKINO;
        e := ERR_INOISSAFE;
    ENDPROC
ENDMODULE
