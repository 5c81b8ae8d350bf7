MODULE sockets_patience
    ! source: bytes that came before a time-out (switch `receive_timeout`): no source; 64 kB in either buffer, then 60 s without progress [mem]; WAIT_MAX [manual]
    ! task: T_CLIENT client
    ! until: 30000000
    ! case: receive_timeout=keep
    ! expect: time-out
    ! expect: waiting 2
    ! expect: abcd
    ! expect: time-out
    ! expect: 131072 bytes, then 60 s
    ! expect: connected 2
    ! case: receive_timeout=drop
    ! expect: time-out
    ! expect: waiting 0
    ! expect: time-out
    ! expect: time-out
    ! expect: 131072 bytes, then 60 s
    ! expect: connected 2
    PROC main()
        VAR socketdev listener;
        VAR socketdev peer;
        VAR string text;
        SocketCreate listener;
        SocketBind listener, "127.0.0.1", 5000;
        SocketListen listener;
        SocketAccept listener, peer;
        SocketReceive peer \Str:=text \ReadNoOfBytes:=4 \Time:=0.2;
        TPWrite "waiting "\Num:=SocketPeek(peer);
        WaitTime 1;
        SocketReceive peer \Str:=text \ReadNoOfBytes:=4 \Time:=0.2;
        IF text <> "" TPWrite text;
        WaitTime 1000;
        SocketClose peer;
        SocketAccept listener, peer \Time:=WAIT_MAX;
        TPWrite "connected " + ValToStr(SocketGetStatus(peer));
    ERROR
        IF ERRNO = ERR_SOCK_TIMEOUT TPWrite "time-out";
        TRYNEXT;
    ENDPROC

    PROC client()
        VAR socketdev own;
        VAR rawbytes raw;
        VAR clock watch;
        VAR num count := 0;
        WaitTime 0.1;
        SocketCreate own;
        SocketConnect own, "127.0.0.1", 5000;
        SocketSend own \Str:="ab";
        WaitTime 0.5;
        SocketSend own \Str:="cd";
        WaitTime 3;
        PackRawBytes 0, raw, 1021 \IntX:=DINT;
        WHILE TRUE DO
            ClkReset watch;
            ClkStart watch;
            SocketSend own \RawData:=raw;
            count := count + RawBytesLen(raw);
        ENDWHILE
    ERROR
        IF ERRNO = ERR_SOCK_TIMEOUT TPWrite "time-out";
        TPWrite ValToStr(count) + " bytes, then " + NumToStr(ClkRead(watch), 0) + " s";
        again;
        RETURN;
    ENDPROC

    PROC again()
        VAR socketdev own;
        WaitTime 20000000;
        SocketCreate own;
        SocketConnect own, "127.0.0.1", 5000;
    ENDPROC
ENDMODULE
