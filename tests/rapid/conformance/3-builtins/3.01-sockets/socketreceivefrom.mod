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
