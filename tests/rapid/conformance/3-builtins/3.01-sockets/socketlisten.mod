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
