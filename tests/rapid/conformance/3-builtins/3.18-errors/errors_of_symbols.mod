! rule: names of errors: symbols
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_TASKNAME;
        e := ERR_NO_TASK;
        e := ERR_NOT_MOVETASK;
        e := ERR_SYM_ACCESS;
        e := ERR_SYMBOL_TYPE;
        e := ERR_STANDNUM;
        e := ERR_CFG_NOTFND;
        e := ERR_CFG_ILLTYPE;
        e := ERR_CFG_LIMIT;
        e := ERR_CFG_INTERNAL;
    ENDPROC
ENDMODULE
