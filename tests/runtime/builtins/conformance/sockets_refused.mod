MODULE sockets_refused
    ! source: which error, and whether the socket has to be created again [mem]; Keyence's CV-X modules RETRY [code]
    ! task: T_SERVER server
    ! case: refused_connect=timeout,failed_connect=again
    ! expect: time-out
    ! expect: time-out
    ! expect: address
    ! expect: created: time-out
    ! expect: connected
    ! expect: hello
    ! case: refused_connect=timeout,failed_connect=create
    ! expect: time-out
    ! expect: other
    ! expect: address
    ! expect: created: time-out
    ! expect: other
    ! expect: status 1
    ! expect: not connected
    ! case: refused_connect=unreachable
    ! expect: unreachable
    ! expect: unreachable
    ! expect: address
    ! expect: created: unreachable
    ! expect: connected
    ! expect: hello
    ! case: refused_connect=closed
    ! expect: closed
    ! expect: closed
    ! expect: address
    ! expect: created: closed
    ! expect: connected
    ! expect: hello
    VAR string before := "";

    PROC main()
        VAR socketdev socket;
        SocketCreate socket;
        SocketConnect socket, "127.0.0.1", 5000;
        SocketConnect socket, "127.0.0.1", 5000;
        SocketClose socket;
        SocketCreate socket;
        SocketConnect socket, "127.0.0.1", 70000;
        before := "created: ";
        SocketConnect socket, "127.0.0.1", 5000;
        before := "";
        WaitTime 1;
        SocketConnect socket, "127.0.0.1", 5000;
        IF SocketGetStatus(socket) = SOCKET_CONNECTED TPWrite "connected";
        IF SocketGetStatus(socket) = SOCKET_CREATED TPWrite "status 1";
        SocketSend socket \Str:="hello";
        WaitTime 1;
    ERROR
        TEST ERRNO
        CASE ERR_SOCK_TIMEOUT:
            TPWrite before + "time-out";
        CASE ERR_SOCK_NET_UNREACH:
            TPWrite before + "unreachable";
        CASE ERR_SOCK_CLOSED:
            TPWrite before + "closed";
        CASE ERR_SOCK_ADDR_INVALID:
            TPWrite before + "address";
        CASE ERR_SOCK_NOT_CONN:
            TPWrite before + "not connected";
        CASE ERR_SOCK_UNSPEC:
            TPWrite before + "other";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC server()
        VAR socketdev listener;
        VAR socketdev accepted;
        VAR string text;
        WaitTime 0.5;
        SocketCreate listener;
        SocketBind listener, "127.0.0.1", 5000;
        SocketListen listener;
        SocketAccept listener, accepted \Time:=5;
        SocketReceive accepted \Str:=text \Time:=5;
        TPWrite text;
    ERROR
        EXIT;
    ENDPROC
ENDMODULE
