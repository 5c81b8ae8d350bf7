MODULE signal_times_s4
    ! source: S4 datasys 2-SetDO-1 and 2-PulseDO-1: 0.1 to 32 s [manual]; 0.001 to 2000 s [mem]
    ! dialect: signal_times=s4
    ! signal: doLamp DO
    ! expect: refused 0.0001
    ! expect: refused 0.05
    ! expect: refused 33
    ! expect: refused 2001
    VAR num at;
    PROC main()
        CONST num times{6} := [0.0001, 0.05, 0.1, 32, 33, 2001];
        FOR i FROM 1 TO 6 DO
            at := times{i};
            SetDO \SDelay:=at, doLamp, 1;
        ENDFOR
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "refused " \Num:=at;
        TRYNEXT;
    ENDPROC
ENDMODULE
