! rule: names of errors: messages
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_RMQ_NAME;
        e := ERR_RMQ_FULL;
        e := ERR_RMQ_INVALID;
        e := ERR_RMQ_INVMSG;
        e := ERR_RMQ_NOMSG;
        e := ERR_RMQ_TIMEOUT;
        e := ERR_RMQ_VALUE;
        e := ERR_RMQ_DIM;
        e := ERR_RMQ_MSGSIZE;
    ENDPROC
ENDMODULE
