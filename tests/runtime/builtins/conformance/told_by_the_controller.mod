MODULE told_by_the_controller
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
            + ValToStr(DnumToNum(ModTimeDnum("told_by_the_controller")) = ModTime("told_by_the_controller"));
    ENDPROC
ENDMODULE
