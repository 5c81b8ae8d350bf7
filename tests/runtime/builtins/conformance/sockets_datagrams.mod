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
