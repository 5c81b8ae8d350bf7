MODULE sockets_limited
    ! source: 32 sockets of a controller, or any number (switch `sockets_limited`) [mem]
    ! case: sockets_limited=true
    ! expect: full at 33
    ! case: sockets_limited=false
    ! expect: 40
    VAR socketdev many{40};
    VAR num at;

    PROC main()
        FOR i FROM 1 TO 40 DO
            at := i;
            SocketCreate many{i};
        ENDFOR
        TPWrite "40";
    ERROR
        IF ERRNO = ERR_SOCK_UNSPEC TPWrite "full at "\Num:=at;
        EXIT;
    ENDPROC
ENDMODULE
