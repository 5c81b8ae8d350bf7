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
