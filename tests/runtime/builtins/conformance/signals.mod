MODULE signals
    ! source: [manual] S4 SetDO, PulseDO, WaitDI, SetGO; AliasIO by 3HAC16581-1; inputs in expressions [K §2.16]
    ! signal: do1 DO
    ! signal: do2 DO
    ! signal: di1 DI
    ! signal: ao1 AO
    ! expect: 0 1
    ! expect: 1
    ! expect: pulse over
    ! expect: TRUE
    ! expect: ERR_WAIT_MAXTIME
    ! expect: high
    ! expect: no alias
    ! expect: 2.5
    ! expect: ERR_ARGVALERR
    VAR signaldo doAlias;

    PROC main()
        VAR bool late;
        VAR num before;
        before := DOutput(do1);
        Set do1;
        TPWrite ValToStr(before) + " " + ValToStr(DOutput(do1));
        SetDO \SDelay:=1, do2, 1;
        WaitDO do2, 1;
        TPWrite ValToStr(do2);
        PulseDO \PLength:=0.5, do1;
        WaitDO do1, 1;
        TPWrite "pulse over";
        WaitDI di1, 1 \MaxTime:=0.2 \TimeFlag:=late;
        TPWrite ValToStr(late);
        WaitDI di1, 1 \MaxTime:=0.2;
        IF di1 = 0 AND do1 = 1 TPWrite "high";
        Set doAlias;
        AliasIO do2, doAlias;
        Reset doAlias;
        IF DOutput(do2) <> 0 TPWrite "wrong";
        SetAO ao1, 2.5;
        TPWrite ValToStr(AOutput(ao1));
        SetDO do1, 5;
    ERROR
        TEST ERRNO
        CASE ERR_WAIT_MAXTIME:
            TPWrite "ERR_WAIT_MAXTIME";
        CASE ERR_NO_ALIASIO_DEF:
            TPWrite "no alias";
        CASE ERR_ARGVALERR:
            TPWrite "ERR_ARGVALERR";
        ENDTEST
        TRYNEXT;
    ENDPROC
ENDMODULE
