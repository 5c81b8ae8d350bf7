! rule: named values: sockets
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := SOCKET_CREATED;
        n := SOCKET_CONNECTED;
        n := SOCKET_BOUND;
        n := SOCKET_LISTENING;
        n := SOCKET_CLOSED;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
