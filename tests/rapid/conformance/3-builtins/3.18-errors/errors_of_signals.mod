! rule: names of errors: signals
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_NORUNUNIT;
        e := ERR_NO_ALIASIO_DEF;
        e := ERR_ALIASIO_DEF;
        e := ERR_ALIASIO_TYPE;
        e := ERR_SIG_NOT_VALID;
        e := ERR_SIG_NAME;
        e := ERR_AO_LIM;
        e := ERR_GO_LIM;
        e := ERR_IOENABLE;
        e := ERR_IODISABLE;
        e := ERR_NAME_INVALID;
        e := ERR_BUSSTATE;
    ENDPROC
ENDMODULE
