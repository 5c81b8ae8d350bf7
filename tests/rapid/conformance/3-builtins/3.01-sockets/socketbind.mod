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
