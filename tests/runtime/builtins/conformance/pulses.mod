MODULE pulses
    ! source: S4 datasys 2-PulseDO, 2-SetDO: a later order drops a pending one (overview 5-53); a dionum is 0 or 1 (switch `dionum`) [manual]
    ! signal: do1 DO
    ! signal: do2 DO
    ! case: dionum=strict
    ! expect: 1 at 0.5
    ! expect: 0 at 0.7
    ! expect: 2: 0
    ! expect: 2: 1
    ! expect: 2: 0
    ! expect: refused
    ! expect: 0
    ! case: dionum=nonzero
    ! expect: 1 at 0.5
    ! expect: 0 at 0.7
    ! expect: 2: 0
    ! expect: 2: 1
    ! expect: 2: 0
    ! expect: 2: 1
    ! expect: 1
    VAR clock watch;
    VAR intnum one;
    VAR intnum two;

    PROC main()
        CONNECT one WITH changed;
        ISignalDO do1, 2, one;
        ClkStart watch;
        SetDO \SDelay:=1, do1, 1;
        WaitTime 0.5;
        PulseDO do1;
        WaitTime 3;
        ! A pulse inverts; \High makes it 1.
        Set do2;
        CONNECT two WITH second;
        ISignalDO do2, 2, two;
        PulseDO \PLength:=0.1, do2;
        WaitTime 1;
        PulseDO \High \PLength:=0.1, do2;
        WaitTime 1;
        Reset do2;
        WaitTime 1;
        SetDO do2, 5;
        WaitTime 1;
        TPWrite ""\Num:=DOutput(do2);
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "refused";
        TRYNEXT;
    ENDPROC

    TRAP changed
        TPWrite ValToStr(DOutput(do1)) + " at " + NumToStr(ClkRead(watch), 1);
    ENDTRAP

    TRAP second
        TPWrite "2: "\Num:=DOutput(do2);
    ENDTRAP
ENDMODULE
