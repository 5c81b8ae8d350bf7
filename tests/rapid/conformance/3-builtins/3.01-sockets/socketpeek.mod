! rule: arguments of SocketPeek
! source: [manual] 3HAC050917
MODULE Demo
    VAR socketdev v_socketdev;
    VAR num r_num;
    PROC main()
        r_num := SocketPeek(v_socketdev);
        r_num := SocketPeek();  ! -> RG311
        r_num := SocketPeek(v_socketdev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
