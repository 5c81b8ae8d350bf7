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
