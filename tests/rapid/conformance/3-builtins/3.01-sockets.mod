!=== socketaccept
! rule: arguments of SocketAccept
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR string v_string;
    PROC main()
        SocketAccept v_socketdev, v_socketdev;
        SocketAccept v_socketdev, v_socketdev \ClientAddress:=v_string \Time:=1;
        SocketAccept v_socketdev;  ! -> RG311
        SocketAccept v_socketdev, v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketbind
! rule: arguments of SocketBind
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    PROC main()
        SocketBind v_socketdev, "x", 1;
        SocketBind v_socketdev, "x";  ! -> RG311
        SocketBind v_socketdev, "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketclose
! rule: arguments of SocketClose
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    PROC main()
        SocketClose v_socketdev;
        SocketClose;  ! -> RG311?
        SocketClose v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketconnect
! rule: arguments of SocketConnect
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    PROC main()
        SocketConnect v_socketdev, "x", 1;
        SocketConnect v_socketdev, "x", 1 \Time:=1;
        SocketConnect v_socketdev, "x";  ! -> RG311
        SocketConnect v_socketdev, "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketcreate
! rule: arguments of SocketCreate
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    PROC main()
        SocketCreate v_socketdev;
        SocketCreate v_socketdev \UDP;
        SocketCreate;  ! -> RG311?
        SocketCreate v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketgetstatus
! rule: arguments of SocketGetStatus
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR socketstatus r_socketstatus;
    PROC main()
        r_socketstatus := SocketGetStatus(v_socketdev);
        r_socketstatus := SocketGetStatus();  ! -> RG311
        r_socketstatus := SocketGetStatus(v_socketdev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketlisten
! rule: arguments of SocketListen
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    PROC main()
        SocketListen v_socketdev;
        SocketListen;  ! -> RG311?
        SocketListen v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketpeek
! rule: arguments of SocketPeek
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR num r_num;
    PROC main()
        r_num := SocketPeek(v_socketdev);
        r_num := SocketPeek();  ! -> RG311
        r_num := SocketPeek(v_socketdev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketreceive
! rule: arguments of SocketReceive
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR string v_string;
    VAR num v_num;
    VAR rawbytes v_rawbytes;
    VAR byte v_byte_array{2};
    PROC main()
        SocketReceive v_socketdev;
        SocketReceive v_socketdev \Str:=v_string \ReadNoOfBytes:=1 \NoRecBytes:=v_num \Time:=1;
        SocketReceive v_socketdev \RawData:=v_rawbytes \ReadNoOfBytes:=1 \NoRecBytes:=v_num \Time:=1;
        SocketReceive v_socketdev \Data:=v_byte_array \ReadNoOfBytes:=1 \NoRecBytes:=v_num \Time:=1;
        SocketReceive;  ! -> RG311?
        SocketReceive v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketreceivefrom
! rule: arguments of SocketReceiveFrom
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR string v_string;
    VAR num v_num;
    VAR rawbytes v_rawbytes;
    VAR byte v_byte_array{2};
    PROC main()
        SocketReceiveFrom v_socketdev, v_string, v_num;
        SocketReceiveFrom v_socketdev \Str:=v_string \ReadNoOfBytes:=1 \NoRecBytes:=v_num, v_string, v_num \Time:=1;
        SocketReceiveFrom v_socketdev \RawData:=v_rawbytes \ReadNoOfBytes:=1 \NoRecBytes:=v_num, v_string, v_num \Time:=1;
        SocketReceiveFrom v_socketdev \Data:=v_byte_array \ReadNoOfBytes:=1 \NoRecBytes:=v_num, v_string, v_num \Time:=1;
        SocketReceiveFrom v_socketdev, v_string;  ! -> RG311
        SocketReceiveFrom v_socketdev, v_string, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketsend
! rule: arguments of SocketSend
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR rawbytes v_rawbytes;
    VAR byte v_byte_array{2};
    PROC main()
        SocketSend v_socketdev;
        SocketSend v_socketdev \Str:="x" \NoOfBytes:=1;
        SocketSend v_socketdev \RawData:=v_rawbytes \NoOfBytes:=1;
        SocketSend v_socketdev \Data:=v_byte_array \NoOfBytes:=1;
        SocketSend;  ! -> RG311?
        SocketSend v_socketdev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== socketsendto
! rule: arguments of SocketSendTo
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR rawbytes v_rawbytes;
    VAR byte v_byte_array{2};
    PROC main()
        SocketSendTo v_socketdev, "x", 1;
        SocketSendTo v_socketdev, "x", 1 \Str:="x" \NoOfBytes:=1;
        SocketSendTo v_socketdev, "x", 1 \RawData:=v_rawbytes \NoOfBytes:=1;
        SocketSendTo v_socketdev, "x", 1 \Data:=v_byte_array \NoOfBytes:=1;
        SocketSendTo v_socketdev, "x";  ! -> RG311
        SocketSendTo v_socketdev, "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
