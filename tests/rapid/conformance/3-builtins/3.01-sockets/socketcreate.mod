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
