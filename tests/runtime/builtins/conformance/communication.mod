!=== queue_for_ever
MODULE queue_for_ever
    ! source: [mem] RMQSendWait without \TimeOut
    ! dialect: queue_timeout=false
    ! task: T_OTHER other
    ! expect: answered after 90
    VAR clock watch;
    PROC main()
        VAR rmqslot partner;
        VAR rmqmessage message;
        VAR num wanted;
        RMQFindSlot partner, "RMQ_T_OTHER";
        ClkStart watch;
        RMQSendWait partner, TRUE, message, wanted;
        TPWrite "answered after " \Num:=Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_RMQ_TIMEOUT TPWrite ValToStr(Round(ClkRead(watch)));
        RETURN;
    ENDPROC

    PROC other()
        VAR rmqmessage message;
        VAR rmqslot sender;
        RMQReadWait message;
        RMQGetMsgHeader message \SenderId:=sender;
        WaitTime 90;
        RMQSendMessage sender, 42;
    ENDPROC
ENDMODULE
!=== queue_timeout
MODULE queue_timeout
    ! source: [mem] RMQSendWait without \TimeOut
    ! task: T_OTHER other
    ! expect: 60
    VAR clock watch;
    PROC main()
        VAR rmqslot partner;
        VAR rmqmessage message;
        VAR num wanted;
        RMQFindSlot partner, "RMQ_T_OTHER";
        ClkStart watch;
        RMQSendWait partner, TRUE, message, wanted;
        TPWrite "answered after " \Num:=Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_RMQ_TIMEOUT TPWrite ValToStr(Round(ClkRead(watch)));
        RETURN;
    ENDPROC

    PROC other()
        VAR rmqmessage message;
        VAR rmqslot sender;
        RMQReadWait message;
        RMQGetMsgHeader message \SenderId:=sender;
        WaitTime 90;
        RMQSendMessage sender, 42;
    ENDPROC
ENDMODULE
!=== queues
MODULE queues
    ! source: 3HAC16581-1 RAPID message queue [manual]; limits and defaults [mem]
    ! task: T_OTHER other
    ! expect: ERR_RMQ_NAME
    ! expect: trap [1,2,3] 7
    ! expect: answer from RMQ_T_OTHER: 42
    ! expect: ERR_RMQ_FULL
    ! expect: num 0
    ! expect: ERR_RMQ_VALUE
    ! expect: ERR_RMQ_TIMEOUT
    ! expect: ERR_RMQ_NOMSG
    VAR intnum arrived;
    VAR rmqslot partner;

    PROC main()
        VAR rmqmessage message;
        VAR rmqheader header;
        VAR rmqslot sender;
        VAR pos p := [1,2,3];
        VAR num answer;
        VAR num wanted;
        WaitTime 0.1;
        RMQFindSlot partner, "RMQ_missing";
        RMQFindSlot partner, "RMQ_T_OTHER";
        RMQSendMessage partner, p \UserDef:=7;
        WaitTime 0.5;
        RMQSendWait partner, TRUE, message, wanted \TimeOut:=5;
        RMQGetMsgData message, answer;
        RMQGetMsgHeader message \SenderId:=sender;
        TPWrite "answer from " + RMQGetSlotName(sender) + ": " + ValToStr(answer);
        RMQFindSlot partner, "RMQ_T_ROB1";
        FOR i FROM 1 TO 6 DO
            RMQSendMessage partner, i;
        ENDFOR
        RMQReadWait message;
        RMQGetMsgHeader message \Header:=header;
        TPWrite header.datatype + " " + ValToStr(header.ndim);
        RMQGetMsgData message, p;
        RMQEmptyQueue;
        RMQReadWait message \TimeOut:=0.2;
        RMQGetMessage message;
    ERROR
        TEST ERRNO
        CASE ERR_RMQ_NAME:
            TPWrite "ERR_RMQ_NAME";
        CASE ERR_RMQ_FULL:
            TPWrite "ERR_RMQ_FULL";
        CASE ERR_RMQ_VALUE:
            TPWrite "ERR_RMQ_VALUE";
        CASE ERR_RMQ_TIMEOUT:
            TPWrite "ERR_RMQ_TIMEOUT";
        CASE ERR_RMQ_NOMSG:
            TPWrite "ERR_RMQ_NOMSG";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC other()
        VAR pos p;
        VAR rmqmessage message;
        VAR rmqslot sender;
        CONNECT arrived WITH on_pos;
        IRMQMessage p, arrived;
        WaitTime 0.4;
        RMQReadWait message;
        RMQGetMsgHeader message \SenderId:=sender;
        RMQSendMessage sender, 42;
    ENDPROC

    TRAP on_pos
        VAR rmqmessage message;
        VAR pos p;
        VAR num user;
        RMQGetMessage message;
        RMQGetMsgData message, p;
        RMQGetMsgHeader message \UserDef:=user;
        TPWrite "trap " + ValToStr(p) + " " + ValToStr(user);
    ENDTRAP
ENDMODULE
!=== raw_bytes
MODULE raw_bytes
    ! source: [manual] 3HAC16581-1 PackRawBytes to RawBytesLen; [code] abb_driver
    ! expect: 8
    ! expect: 4 104
    ! expect: 1.5
    ! expect: -3
    ! expect: hello
    ! expect: 6
    ! expect: 65534
    ! expect: beyond
    ! expect: not whole
    ! expect: 0
    RECORD message
        num kind;
        rawbytes body;
    ENDRECORD
    VAR message kept;

    PROC main()
        VAR rawbytes raw;
        VAR rawbytes copy;
        VAR num n;
        VAR byte b;
        VAR string s;
        PackRawBytes 1.5, raw, 5 \Float4;
        TPWrite ValToStr(RawBytesLen(raw));
        PackRawBytes 104, raw, 4, \Hex1;
        UnpackRawBytes raw, 4, b \Hex1;
        TPWrite "4 " + ValToStr(b);
        UnpackRawBytes raw, 5, n \Float4;
        TPWrite ValToStr(n);
        PackRawBytes -3, raw \Network, 1 \IntX:=INT;
        UnpackRawBytes raw \Network, 1, n \IntX:=INT;
        TPWrite ValToStr(n);
        ClearRawBytes raw;
        PackRawBytes "hello", raw, 1 \ASCII;
        CopyRawBytes raw, 1, kept.body, 2;
        UnpackRawBytes kept.body, 2, s \ASCII:=5;
        TPWrite s;
        TPWrite ValToStr(RawBytesLen(kept.body));
        PackRawBytes 65534, copy, 1 \IntX:=UINT;
        UnpackRawBytes copy, 1, n \IntX:=UINT;
        TPWrite ValToStr(n);
        UnpackRawBytes copy, 1, n \IntX:=DINT;
        PackRawBytes 0.5, copy, 1 \IntX:=DINT;
        fresh;
    ERROR
        TEST ERRNO
        CASE ERR_OUTOFBND:
            TPWrite "beyond";
        CASE ERR_INT_NOTVAL:
            TPWrite "not whole";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC fresh()
        VAR rawbytes own;
        TPWrite ValToStr(RawBytesLen(own));
        PackRawBytes 1, own, 1 \IntX:=DINT;
        IF kept.kind < 1 THEN
            kept.kind := kept.kind + 1;
        ENDIF
    ENDPROC
ENDMODULE
!=== raw_bytes_dialects
MODULE raw_bytes_dialects
    ! source: 3HAC16581-1 [manual] says nothing of a gap, of what is beyond the valid length; [mem] what is done
    ! case:
    ! A gap is filled with 0.
    ! expect: 8 513
    ! expect: beyond
    ! expect: kept 5
    ! case: pack_beyond=error
    ! expect: beyond
    ! expect: 6 513
    ! expect: beyond
    ! expect: kept 5
    ! case: unpack_beyond=zero
    ! expect: 8 513
    ! expect: 513
    ! expect: beyond
    PROC main()
        VAR rawbytes raw;
        VAR num n;
        PackRawBytes "ab", raw, 1 \ASCII;
        PackRawBytes 513, raw, 5 \IntX:=DINT;
        IF RawBytesLen(raw) = 2 PackRawBytes 513, raw, 3 \IntX:=DINT;
        UnpackRawBytes raw, RawBytesLen(raw) - 3, n \IntX:=DINT;
        TPWrite ValToStr(RawBytesLen(raw)) + " " + ValToStr(n);
        IF RawBytesLen(raw) = 8 THEN
            UnpackRawBytes raw, 3, n \IntX:=INT;
            IF n <> 0 TPWrite "not 0";
        ENDIF
        beyond;
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "beyond";
        TRYNEXT;
    ENDPROC
    PROC beyond()
        VAR rawbytes raw;
        VAR rawbytes none;
        VAR num n := 5;
        PackRawBytes 513, raw, 1 \IntX:=INT;
        UnpackRawBytes raw, 1, n \IntX:=DINT;
        IF n = 513 TPWrite "513";
        UnpackRawBytes none, 1023, n \IntX:=DINT;
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "beyond";
        IF n = 5 TPWrite "kept 5";
        RETURN;
    ENDPROC
ENDMODULE
!=== sockets
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
!=== sockets_calls
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
        time_limit;
    ENDPROC

    PROC logged()
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
        logged;
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
        logged;
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
        logged;
        TRYNEXT;
    ENDPROC

    PROC time_limit()
        VAR clock watch;
        SocketCreate socket;
        SocketBind socket, "127.0.0.1", 5000;
        SocketListen socket;
        ClkStart watch;
        SocketAccept socket, other;
        TPWrite NumToStr(ClkRead(watch), 0) + " s";
    ERROR
        logged;
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== sockets_datagrams
MODULE sockets_datagrams
    ! source: [manual] 3HAC16581-1 SocketSendTo, SocketReceiveFrom
    ! task: T_SENDER sender
    ! expect: hello
    ! expect: back
    PROC main()
        VAR socketdev one;
        VAR string text;
        VAR string address;
        VAR num port;
        SocketCreate one \UDP;
        SocketBind one, "127.0.0.1", 5000;
        SocketReceiveFrom one \Str:=text, address, port \Time:=5;
        TPWrite text;
        SocketSendTo one, address, port \Str:="back";
    ENDPROC

    PROC sender()
        VAR socketdev two;
        VAR string answer;
        VAR string address;
        VAR num port;
        WaitTime 0.1;
        SocketCreate two \UDP;
        SocketSendTo two, "127.0.0.1", 5000 \Str:="hello";
        SocketReceiveFrom two \Str:=answer, address, port \Time:=5;
        TPWrite answer;
    ENDPROC
ENDMODULE
!=== sockets_limited
MODULE sockets_limited
    ! source: 32 sockets of a controller, or any number (switch `sockets_limited`) [mem]
    ! case: sockets_limited=true
    ! expect: full at 33
    ! case: sockets_limited=false
    ! expect: 40
    VAR socketdev many{40};
    VAR num at;

    PROC main()
        FOR i FROM 1 TO 40 DO
            at := i;
            SocketCreate many{i};
        ENDFOR
        TPWrite "40";
    ERROR
        IF ERRNO = ERR_SOCK_UNSPEC TPWrite "full at "\Num:=at;
        EXIT;
    ENDPROC
ENDMODULE
!=== sockets_time_limits
MODULE sockets_time_limits
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
!=== sockets_default_times
MODULE sockets_default_times
    ! source: 60 s without \Time of SocketConnect, SocketAccept and SocketReceive [manual, CSDN 37596743]; a time-out every 60 to 61 s in the log of an IRB 120 with 5.15
    ! task: T_LATE late
    ! until: 400
    ! expect: connect: time-out after 60 s
    ! expect: connect: time-out after 3 s
    ! expect: accept: time-out after 60 s
    ! expect: connected after 20 s
    ! expect: receive: time-out after 60 s
    VAR clock watch;
    VAR string what;

    PROC main()
        VAR socketdev own;
        VAR socketdev server;
        VAR socketdev peer;
        VAR string text;
        SocketCreate own;
        begin "connect";
        SocketConnect own, "127.0.0.1", 5000;
        begin "connect";
        SocketConnect own, "127.0.0.1", 5000 \Time:=3;
        SocketCreate server;
        SocketBind server, "127.0.0.1", 5001;
        SocketListen server;
        begin "accept";
        SocketAccept server, peer;
        begin "connect";
        SocketConnect own, "127.0.0.1", 5000;
        TPWrite "connected after " + NumToStr(ClkRead(watch), 0) + " s";
        begin "receive";
        SocketReceive own \Str:=text;
    ERROR
        IF ERRNO = ERR_SOCK_TIMEOUT TPWrite what + ": time-out after " + NumToStr(ClkRead(watch), 0) + " s";
        TRYNEXT;
    ENDPROC

    PROC begin(string name)
        what := name;
        ClkReset watch;
        ClkStart watch;
    ENDPROC

    PROC late()
        VAR socketdev listener;
        VAR socketdev silent;
        WaitTime 60 + 3 + 60 + 19.5;
        SocketCreate listener;
        SocketBind listener, "127.0.0.1", 5000;
        SocketListen listener;
        SocketAccept listener, silent;
        WaitTime 1000;
    ENDPROC
ENDMODULE
!=== sockets_refused
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
        SocketConnect socket, "127.0.0.1", 5000 \Time:=0.1;
        SocketConnect socket, "127.0.0.1", 5000 \Time:=0.1;
        SocketClose socket;
        SocketCreate socket;
        SocketConnect socket, "127.0.0.1", 70000;
        before := "created: ";
        SocketConnect socket, "127.0.0.1", 5000 \Time:=0.1;
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
!=== sockets_stream
MODULE sockets_stream
    ! source: [manual] 3HAC16581-1; [code] abb_driver: rawbytes are filled from byte 1, their length is what came
    ! task: T_CLIENT client
    ! expect: 4: abcd
    ! expect: 3: efg
    ! expect: count 3
    ! expect: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx
    ! expect: yz
    ! expect: [1,2,9,9]
    ! expect: argument
    ! expect: argument
    ! expect: argument
    ! expect: argument
    ! expect: argument 0
    ! expect: argument 81
    ! expect: argument -1
    ! expect: argument 1.5
    ! expect: bye
    ! expect: status 2
    ! expect: closed
    ! expect: status 5
    ! expect: reset
    VAR string tried := "";
    VAR socketdev listener;

    PROC main()
        VAR socketdev peer;
        VAR rawbytes raw;
        VAR num count;
        VAR string text;
        VAR byte data{4} := [9,9,9,9];
        CONST num wrong{4} := [0, 81, -1, 1.5];
        SocketCreate listener;
        SocketBind listener, "127.0.0.1", 5000;
        SocketListen listener;
        SocketAccept listener, peer;
        PackRawBytes "something longer that was there", raw, 1 \ASCII;
        SocketReceive peer \RawData:=raw \ReadNoOfBytes:=4;
        show raw;
        SocketReceive peer \RawData:=raw \ReadNoOfBytes:=3 \NoRecBytes:=count;
        show raw;
        TPWrite "count "\Num:=count;
        WaitTime 1;
        SocketReceive peer \Str:=text;
        TPWrite text;
        SocketReceive peer \Str:=text;
        TPWrite text;
        SocketReceive peer \Data:=data \Time:=5;
        TPWrite ValToStr(data);
        WaitTime 1;
        FOR i FROM 1 TO 4 DO
            tried := " " + ValToStr(wrong{i});
            SocketReceive peer \Str:=text \ReadNoOfBytes:=wrong{i};
        ENDFOR
        SocketReceive peer \Str:=text;
        TPWrite text;
        TPWrite "status " + ValToStr(SocketGetStatus(peer));
        SocketReceive peer \Str:=text;
        TPWrite "status " + ValToStr(SocketGetStatus(peer));
        SocketClose peer;
        SocketAccept listener, peer;
        WaitTime 0.1;
        SocketClose peer;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "argument" + tried;
        IF ERRNO = ERR_SOCK_CLOSED TPWrite "closed";
        TRYNEXT;
    ENDPROC

    PROC show(VAR rawbytes raw)
        VAR string text;
        UnpackRawBytes raw, 1, text \ASCII:=RawBytesLen(raw);
        TPWrite ValToStr(RawBytesLen(raw)) + ": " + text;
    ENDPROC

    PROC client()
        VAR socketdev own;
        VAR rawbytes raw;
        VAR string long := "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";
        VAR byte three{3} := [1,2,3];
        VAR byte large{1} := [256];
        WaitTime 0.1;
        SocketCreate own;
        SocketConnect own, "127.0.0.1", 5000;
        SocketSend own \Str:="ab";
        WaitTime 0.05;
        SocketSend own \Str:="cde";
        WaitTime 0.05;
        SocketSend own \Str:="fg";
        WaitTime 0.5;
        SocketSend own \Str:=long + long;
        SocketSend own \Str:="yz";
        WaitTime 1;
        SocketSend own \Data:=three \NoOfBytes:=2;
        WaitTime 0.5;
        PackRawBytes "abc", raw, 1 \ASCII;
        SocketSend own \RawData:=raw \NoOfBytes:=0;
        SocketSend own \RawData:=raw \NoOfBytes:=4;
        SocketSend own \RawData:=raw \NoOfBytes:=1.5;
        SocketSend own \Data:=large;
        ! What was sent before a close still arrives.
        SocketSend own \Str:="bye";
        SocketClose own;
        WaitTime 1;
        ! Closing with unread bytes resets the peer, as TCP does.
        SocketCreate own;
        SocketConnect own, "127.0.0.1", 5000;
        SocketSend own \Str:="never read";
        WaitTime 1;
        SocketSend own \Str:="again";
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "argument";
        IF ERRNO = ERR_SOCK_CLOSED TPWrite "reset";
        TRYNEXT;
    ENDPROC
ENDMODULE
