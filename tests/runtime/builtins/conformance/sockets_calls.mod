MODULE sockets_calls
    ! source: [manual] 3HAC16581-1; [code] abb_driver asks for the status at every step; 32 sockets [mem]
    ! expect: 5
    ! expect: 1
    ! expect: 3
    ! expect: 4
    ! expect: 5
    ! expect: 5
    ! expect: closed
    ! expect: closed
    ! expect: other
    ! expect: not bound
    ! expect: not connected
    ! expect: not connected
    ! expect: bound
    ! expect: in use
    ! expect: 3
    ! expect: other
    ! expect: other
    ! expect: 1
    ! expect: time-out
    ! expect: 60 s
    VAR socketdev socket;
    VAR socketdev other;
    VAR socketdev many{33};

    PROC main()
        states;
        wrong_order;
        one_port;
        too_many;
        patience;
    ENDPROC

    PROC told()
        TEST ERRNO
        CASE ERR_SOCK_CLOSED:
            TPWrite "closed";
        CASE ERR_SOCK_UNSPEC:
            TPWrite "other";
        CASE ERR_SOCK_NOT_BOUND:
            TPWrite "not bound";
        CASE ERR_SOCK_NOT_CONN:
            TPWrite "not connected";
        CASE ERR_SOCK_IS_BOUND:
            TPWrite "bound";
        CASE ERR_SOCK_ADDR_INUSE:
            TPWrite "in use";
        CASE ERR_SOCK_TIMEOUT:
            TPWrite "time-out";
        ENDTEST
    ENDPROC

    PROC show(VAR socketdev one)
        TPWrite ValToStr(SocketGetStatus(one));
    ENDPROC

    ! A fresh socket shows as closed.
    PROC states()
        show socket;
        SocketCreate socket;
        show socket;
        SocketBind socket, "127.0.0.1", 5000;
        show socket;
        SocketListen socket;
        show socket;
        SocketClose socket;
        show socket;
        SocketClose socket;
        show socket;
    ENDPROC

    PROC wrong_order()
        VAR num count;
        SocketBind socket, "127.0.0.1", 1;
        SocketListen socket;
        SocketCreate socket;
        SocketCreate socket;
        SocketListen socket;
        SocketSend socket \Str:="x";
        count := SocketPeek(socket);
        SocketClose socket;
    ERROR
        told;
        TRYNEXT;
    ENDPROC

    PROC one_port()
        SocketCreate socket;
        SocketCreate other;
        SocketBind socket, "127.0.0.1", 5000;
        SocketBind socket, "127.0.0.1", 5001;
        SocketBind other, "127.0.0.1", 5000;
        SocketClose socket;
        SocketBind other, "127.0.0.1", 5000;
        show other;
        SocketClose other;
    ERROR
        told;
        TRYNEXT;
    ENDPROC

    ! A leak is stopped by an error; a closed one makes room.
    PROC too_many()
        FOR i FROM 1 TO 33 DO
            SocketCreate many{i};
        ENDFOR
        SocketCreate many{33};
        SocketClose many{1};
        SocketCreate many{33};
        show many{33};
        FOR i FROM 2 TO 33 DO
            SocketClose many{i};
        ENDFOR
    ERROR
        told;
        TRYNEXT;
    ENDPROC

    PROC patience()
        VAR clock watch;
        SocketCreate socket;
        SocketBind socket, "127.0.0.1", 5000;
        SocketListen socket;
        ClkStart watch;
        SocketAccept socket, other;
        TPWrite NumToStr(ClkRead(watch), 0) + " s";
    ERROR
        told;
        TRYNEXT;
    ENDPROC
ENDMODULE
