MODULE send_attends
    ! source: no manual settles whether a trap comes while SocketSend waits: a switch
    ! task: T_PEER peer
    ! case: send_attends=true
    ! do: start, run 70
    ! expect: 1
    ! case: send_attends=false
    ! do: start, run 70
    ! expect: 60
    VAR socketdev server;
    VAR socketdev client;
    VAR rawbytes data;
    VAR intnum alarm;
    VAR clock watch;
    PROC main()
        PackRawBytes 0, data, 1021 \IntX:=DINT;
        SocketCreate server;
        SocketBind server, "10.0.0.1", 5000;
        SocketListen server;
        SocketAccept server, client;
        CONNECT alarm WITH on_alarm;
        ITimer \Single, 1, alarm;
        ClkStart watch;
        WHILE TRUE DO
            SocketSend client \RawData:=data;
        ENDWHILE
    ERROR
        TPWrite ValToStr(Round(ClkRead(watch)));
        EXIT;
    ENDPROC
    TRAP on_alarm
        SocketClose client;
    ENDTRAP
    PROC peer()
        VAR socketdev own;
        WaitTime 0.1;
        SocketCreate own;
        SocketConnect own, "10.0.0.1", 5000;
        WaitTime 100;
    ENDPROC
ENDMODULE
