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
