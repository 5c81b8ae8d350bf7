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
