MODULE sockets
    ! source: [manual] 3HAC16581-1 socket messaging; [code] abb_driver: server by status, ERR_SOCK_CLOSED
    ! task: T_CLIENT client
    ! expect: 5
    ! expect: 4
    ! expect: 2
    ! expect: ping
    ! expect: 4 bytes
    ! expect: time-out
    ! expect: closed
    ! expect: 5
    VAR socketdev server;
    VAR socketdev peer;

    PROC main()
        VAR string text;
        VAR string address;
        VAR rawbytes raw;
        VAR num count;
        TPWrite ValToStr(SocketGetStatus(server));
        IF SocketGetStatus(server) = SOCKET_CLOSED SocketCreate server;
        IF SocketGetStatus(server) = SOCKET_CREATED SocketBind server, GetSysInfo(\LanIp), 1025;
        IF SocketGetStatus(server) = SOCKET_BOUND SocketListen server;
        TPWrite ValToStr(SocketGetStatus(server));
        SocketAccept server, peer \ClientAddress:=address \Time:=WAIT_MAX;
        TPWrite ValToStr(SocketGetStatus(peer));
        SocketReceive peer \Str:=text;
        TPWrite text;
        SocketReceive peer, \RawData:=raw, \ReadNoOfBytes:=4, \NoRecBytes:=count, \Time:=5;
        TPWrite ValToStr(count) + " bytes";
        SocketReceive peer \RawData:=raw \Time:=0.5;
        SocketReceive peer \RawData:=raw;
        TPWrite ValToStr(SocketGetStatus(peer));
        SocketClose peer;
        SocketClose server;
    ERROR
        IF ERRNO = ERR_SOCK_TIMEOUT TPWrite "time-out";
        IF ERRNO = ERR_SOCK_CLOSED TPWrite "closed";
        TRYNEXT;
    ENDPROC

    PROC client()
        VAR socketdev own;
        VAR rawbytes raw;
        WaitTime 0.1;
        SocketCreate own;
        SocketConnect own, "127.0.0.1", 1025;
        SocketSend own \Str:="ping";
        WaitTime 0.2;
        PackRawBytes 7, raw, 1 \IntX:=DINT;
        SocketSend own \RawData:=raw;
        WaitTime 2;
        SocketClose own;
    ENDPROC
ENDMODULE
