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
