!=== cyclic_bools
MODULE cyclic_bools
    ! source: [manual 3HAC050917] SetupCyclicBool, RemoveCyclicBool, GetNextCyclicBool, IsCyclicBool; the cycle
    ! of 12 ms, 60 at most [mem]
    ! signal: di1 DI
    ! signal: do1 DO
    ! signal: do2 DO
    ! expect: 60 2 flag wide TRUE FALSE TRUE
    ! expect: FALSE 0
    ! expect: TRUE 1
    ! expect: FALSE 0 TRUE
    ! expect: 1 FALSE TRUE
    ! expect: no such
    ! expect: own function
    ! expect: 0
    PERS bool flag := TRUE;
    PERS bool wide := FALSE;
    PERS bool other := FALSE;
    PERS num level := 0;
    PROC main()
        VAR num place := 0;
        VAR string first;
        VAR string second;
        SetupCyclicBool flag, do1 = 1 AND level > 2 \Signal:=do2;
        SetupCyclicBool wide, NOT other;
        IF GetNextCyclicBool(place, first) AND GetNextCyclicBool(place, second)
            TPWrite ValToStr(GetMaxNumberOfCyclicBool()) + " " + ValToStr(GetNumberOfCyclicBool()) + " "
                + first + " " + second + " " + ValToStr(IsCyclicBool(flag)) + " "
                + ValToStr(IsCyclicBool("other")) + " " + ValToStr(IsCyclicBool("wide" \TaskName:="T_ROB1"));
        show;
        SetDO do1, 1;
        level := 3;
        WaitTime 0.02;
        show;
        level := 0;
        other := TRUE;
        WaitTime 0.02;
        TPWrite ValToStr(flag) + " " + ValToStr(DOutput(do2)) + " " + ValToStr(NOT wide);
        RemoveCyclicBool flag;
        level := 3;
        WaitTime 0.02;
        TPWrite ValToStr(GetNumberOfCyclicBool()) + " " + ValToStr(flag) + " " + ValToStr(IsCyclicBool("wide"));
        RemoveCyclicBool "flag";
        SetupCyclicBool flag, mine();
        RemoveAllCyclicBool \AllTasks;
        TPWrite ValToStr(GetNumberOfCyclicBool());
    ERROR
        IF IsCyclicBool(wide) AND level = 3 THEN
            level := 4;
            TPWrite "no such";
        ELSE
            TPWrite "own function";
        ENDIF
        TRYNEXT;
    ENDPROC
    PROC show()
        TPWrite ValToStr(flag) + " " + ValToStr(DOutput(do2));
    ENDPROC
    FUNC bool mine()
        RETURN TRUE;
    ENDFUNC
ENDMODULE
!=== pulses
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
!=== signal_calls
MODULE signal_calls
    ! source: S4 datasys 2-Set, 2-InvertDO, 2-PulseDO, 2-SetGO, 2-SetAO [manual]; AliasIO by 3HAC16581-1; pulses from 0.001 to 2000 s [mem]
    ! signal: do1 DO
    ! signal: do2 DO
    ! signal: di1 DI
    ! signal: go1 GO 4
    ! signal: gi1 GI 32
    ! signal: ao1 AO
    ! do: signal gi1 4294967295, start, run 30
    ! expect: set 1
    ! expect: inverted 0
    ! expect: reset 0
    ! expect: refused 0
    ! expect: refused 0.0001
    ! expect: refused 2001
    ! expect: GO 12
    ! expect: GO limit 16
    ! expect: GO limit -1
    ! expect: GO limit 1.5
    ! expect: AO 2.5
    ! expect: 4294967295
    ! expect: 4.29497E+09
    ! expect: no alias
    ! expect: FALSE
    ! expect: by name 11
    ! expect: by signal 1
    ! expect: FALSE
    ! expect: no such signal
    ! expect: other type
    ! expect: no such signal
    ! state: finished
    VAR signaldo lamp;
    VAR num at;

    PROC main()
        outputs;
        aliases;
    ENDPROC

    PROC outputs()
        CONST num lengths{3} := [0,0.0001,2001];
        CONST num groups{4} := [12,16,-1,1.5];
        VAR dnum whole;
        Set do1;
        TPWrite "set "\Num:=DOutput(do1);
        InvertDO do1;
        TPWrite "inverted "\Num:=DOutput(do1);
        SetDO do1, 1;
        Reset do1;
        TPWrite "reset "\Num:=DOutput(do1);
        FOR i FROM 1 TO 3 DO
            at := lengths{i};
            PulseDO \PLength:=at, do1;
        ENDFOR
        FOR i FROM 1 TO 4 DO
            at := groups{i};
            SetGO go1, at;
            IF i = 1 TPWrite "GO "\Num:=GOutput(go1);
        ENDFOR
        SetAO ao1, 2.5;
        TPWrite "AO "\Num:=AOutput(ao1);
        TPWrite ""\Dnum:=GInputDnum(gi1);
        TPWrite ""\Num:=GInput(gi1);
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "refused "\Num:=at;
        IF ERRNO = ERR_GO_LIM TPWrite "GO limit "\Num:=at;
        TRYNEXT;
    ENDPROC

    PROC aliases()
        VAR string name := "do1";
        VAR string none := "none";
        Set lamp;
        TPWrite ""\Bool:=ValidIO(lamp);
        AliasIO name, lamp;
        Set lamp;
        TPWrite "by name " + ValToStr(DOutput(do1))\Num:=DOutput(lamp);
        AliasIO do2, lamp;
        Set lamp;
        TPWrite "by signal "\Num:=DOutput(do2);
        AliasIOReset lamp;
        TPWrite ""\Bool:=ValidIO(lamp);
        AliasIO none, lamp;
        AliasIO di1, lamp;
        AliasIO do1, do2;
    ERROR
        IF ERRNO = ERR_NO_ALIASIO_DEF TPWrite "no alias";
        IF ERRNO = ERR_ALIASIO_DEF TPWrite "no such signal";
        IF ERRNO = ERR_ALIASIO_TYPE TPWrite "other type";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== signal_times
MODULE signal_times
    ! source: S4 datasys 2-SetDO-1 and 2-PulseDO-1: 0.1 to 32 s [manual]; 0.001 to 2000 s [mem]
    ! signal: doLamp DO
    ! expect: refused 0.0001
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
!=== signal_times_s4
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
!=== signals
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
!=== test_signals
MODULE test_signals
    ! source: gizatt/ABB-IRB140 [code]: a force sensor's signals on twelve channels
    ! robot: irb120
    ! expect: channel
    ! expect: 0
    ! expect: channel
    ! expect: axis
    ! expect: no signal
    ! fault: 194905 14
    PROC main()
        each;
        TestSignReset;
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 1, 6, ROB_1, 1, 0;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "no signal";
        TRYNEXT;
    ENDPROC

    PROC each()
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 3, 203, ROB_1, 1, 0;
        TPWrite ValToStr(TestSignRead(3));
        TestSignDefine 13, 203, ROB_1, 1, 0;
        TestSignDefine 3, 9, ROB_1, 7, 0;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "channel";
        IF ERRNO = ERR_AXIS_PAR TPWrite "axis";
        TRYNEXT;
    ENDPROC
ENDMODULE
