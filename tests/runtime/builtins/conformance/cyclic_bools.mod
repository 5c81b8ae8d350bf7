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
