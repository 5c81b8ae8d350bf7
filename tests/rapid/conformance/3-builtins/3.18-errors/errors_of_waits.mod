! rule: names of errors: waits
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_WAIT_MAXTIME;
        e := ERR_WAIT_MAX;
        e := ERR_WAITSYNCTASK;
        e := ERR_DEV_MAXTIME;
        e := ERR_TIMEOUT;
    ENDPROC
ENDMODULE
