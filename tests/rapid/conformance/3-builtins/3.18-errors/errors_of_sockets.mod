! rule: names of errors: sockets
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_SOCK_CLOSED;
        e := ERR_SOCK_TIMEOUT;
        e := ERR_SOCK_ADDR_INUSE;
        e := ERR_SOCK_ADDR_INVALID;
        e := ERR_SOCK_IS_BOUND;
        e := ERR_SOCK_NOT_BOUND;
        e := ERR_SOCK_IS_CONN;
        e := ERR_SOCK_NOT_CONN;
        e := ERR_SOCK_NET_UNREACH;
        e := ERR_SOCK_UNSPEC;
    ENDPROC
ENDMODULE
