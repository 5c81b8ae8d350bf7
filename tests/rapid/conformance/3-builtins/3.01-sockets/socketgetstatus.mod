! rule: arguments of SocketGetStatus
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR socketstatus r_socketstatus;
    PROC main()
        r_socketstatus := SocketGetStatus(v_socketdev);
        r_socketstatus := SocketGetStatus();  ! -> RG311
        r_socketstatus := SocketGetStatus(v_socketdev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
