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
