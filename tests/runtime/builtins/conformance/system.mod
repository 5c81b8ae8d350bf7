!=== clocks
MODULE clocks
    ! source: [manual] S4 ClkStart to ClkReset; CDate, CTime
    ! expect: 1.5
    ! expect: 1.5
    ! expect: 0
    ! expect: 10 8
    VAR clock watch;

    PROC main()
        ClkStart watch;
        WaitTime 1.5;
        ClkStop watch;
        TPWrite ValToStr(Round(ClkRead(watch) \Dec:=2));
        WaitTime 1;
        TPWrite ValToStr(Round(ClkRead(watch) \Dec:=2));
        ClkReset watch;
        TPWrite ValToStr(ClkRead(watch));
        TPWrite ValToStr(StrLen(CDate())) + " " + ValToStr(StrLen(CTime()));
    ENDPROC
ENDMODULE
!=== dialogs
MODULE dialogs
    ! source: [manual] S4 TPReadNum, TPReadFK; ERR_TP_NO_CLIENT without an operator (3HAC16581-1)
    ! expect: how many?
    ! expect: no operator
    ! expect: FALSE
    PROC main()
        VAR num answer;
        VAR errnum broken;
        TPWrite "how many?";
        TPReadNum answer, "?";
        TPReadFK answer, "?", "a", "", "", "", "" \BreakFlag:=broken;
        IF broken <> ERR_TP_NO_CLIENT TPWrite "wrong";
        TPWrite ValToStr(UIClientExist());
    ERROR
        IF ERRNO = ERR_TP_NO_CLIENT TPWrite "no operator";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== reported_by_controller
MODULE reported_by_controller
    ! source: [manual 3HAC050917] GetSignalOrigin, GetTSPStatus, FileTimeDnum, ModTimeDnum, IsBrakeCheckActive; numbers of
    ! the named values [mem]
    ! signal: do1 DO
    ! expect: TRUE do1
    ! expect: TRUE
    ! expect: TRUE do1
    ! expect: TRUE FALSE
    ! expect: TRUE TRUE
    VAR signaldo gripper;
    PROC main()
        VAR string name;
        VAR string digits;
        VAR iodev file;
        TPWrite ValToStr(GetSignalOrigin(do1, name) = SIGORIG_CFG) + " " + name;
        TPWrite ValToStr(GetSignalOrigin(gripper, name) = SIGORIG_NONE) + name;
        AliasIO do1, gripper;
        TPWrite ValToStr(GetSignalOrigin(gripper, name) = SIGORIG_ALIAS) + " " + name;
        TPWrite ValToStr(GetTSPStatus("T_ROB1") = TSP_NORMAL_CHECKED) + " " + ValToStr(IsBrakeCheckActive());
        Open "HOME:" \File:="a.txt", file \Write;
        Close file;
        TPWrite ValToStr(DnumToStr(FileTimeDnum("HOME:/a.txt" \StrDig:=digits), 0) = digits) + " "
            + ValToStr(DnumToNum(ModTimeDnum("reported_by_controller")) = ModTime("reported_by_controller"));
    ENDPROC
ENDMODULE
