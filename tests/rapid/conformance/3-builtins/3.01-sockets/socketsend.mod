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
