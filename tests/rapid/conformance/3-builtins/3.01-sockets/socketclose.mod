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
