!=== cdate
! rule: arguments of CDate
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := CDate();
        r_string := CDate(1);  ! -> RG311
        r_string := CDate(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== clkread
! rule: arguments of ClkRead
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    VAR num r_num;
    PROC main()
        r_num := ClkRead(v_clock);
        r_num := ClkRead(v_clock \HighRes);
        r_num := ClkRead();  ! -> RG311
        r_num := ClkRead(v_clock \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== clkreset
! rule: arguments of ClkReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkReset v_clock;
        ClkReset;  ! -> RG311?
        ClkReset v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== clkstart
! rule: arguments of ClkStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkStart v_clock;
        ClkStart;  ! -> RG311?
        ClkStart v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== clkstop
! rule: arguments of ClkStop
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    PROC main()
        ClkStop v_clock;
        ClkStop;  ! -> RG311?
        ClkStop v_clock \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ctime
! rule: arguments of CTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := CTime();
        r_string := CTime(1);  ! -> RG311
        r_string := CTime(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== dim
! rule: arguments of Dim
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR num r_num;
    PROC main()
        r_num := Dim(v_num, 1);
        r_num := Dim(v_num);  ! -> RG311
        r_num := Dim(v_num, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== eventtype
! rule: arguments of EventType
! source: [manual] 3HAC050917
MODULE Demo
    VAR event_type r_event_type;
    PROC main()
        r_event_type := EventType();
        r_event_type := EventType(1);  ! -> RG311
        r_event_type := EventType(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== exechandler
! rule: arguments of ExecHandler
! source: [manual] 3HAC050917
MODULE Demo
    VAR handler_type r_handler_type;
    PROC main()
        r_handler_type := ExecHandler();
        r_handler_type := ExecHandler(1);  ! -> RG311
        r_handler_type := ExecHandler(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== execlevel
! rule: arguments of ExecLevel
! source: [manual] 3HAC050917
MODULE Demo
    VAR exec_level r_exec_level;
    PROC main()
        r_exec_level := ExecLevel();
        r_exec_level := ExecLevel(1);  ! -> RG311
        r_exec_level := ExecLevel(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== getmecunitname
! rule: arguments of GetMecUnitName
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR string r_string;
    PROC main()
        r_string := GetMecUnitName(v_mecunit);
        r_string := GetMecUnitName();  ! -> RG311
        r_string := GetMecUnitName(v_mecunit \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== getserviceinfo
! rule: arguments of GetServiceInfo
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR string r_string;
    PROC main()
        r_string := GetServiceInfo(v_mecunit);
        r_string := GetServiceInfo(v_mecunit \DutyTimeCnt);
        r_string := GetServiceInfo();  ! -> RG311
        r_string := GetServiceInfo(v_mecunit \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== getsysinfo
! rule: arguments of GetSysInfo
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := GetSysInfo();
        r_string := GetSysInfo(\SerialNo);
        r_string := GetSysInfo(\SWVersion);
        r_string := GetSysInfo(\SWVersionName);
        r_string := GetSysInfo(\RobotType);
        r_string := GetSysInfo(\CtrlId);
        r_string := GetSysInfo(\LanIp);
        r_string := GetSysInfo(\CtrlLang);
        r_string := GetSysInfo(\SystemName);
        r_string := GetSysInfo(1);  ! -> RG311
        r_string := GetSysInfo(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== gettime
! rule: arguments of GetTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := GetTime();
        r_num := GetTime(\WDay);
        r_num := GetTime(\Hour);
        r_num := GetTime(\Min);
        r_num := GetTime(\Sec);
        r_num := GetTime(1);  ! -> RG311
        r_num := GetTime(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== ispers
! rule: arguments of IsPers
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := IsPers(v_num);
        r_bool := IsPers();  ! -> RG311
        r_bool := IsPers(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== isstopstateevent
! rule: arguments of IsStopStateEvent
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsStopStateEvent();
        r_bool := IsStopStateEvent(\PPMoved);
        r_bool := IsStopStateEvent(\PPToMain);
        r_bool := IsStopStateEvent(1);  ! -> RG311
        r_bool := IsStopStateEvent(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== issysid
! rule: arguments of IsSysId
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsSysId("x");
        r_bool := IsSysId();  ! -> RG311
        r_bool := IsSysId("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== isvar
! rule: arguments of IsVar
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := IsVar(v_num);
        r_bool := IsVar();  ! -> RG311
        r_bool := IsVar(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== opmode
! rule: arguments of OpMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := OpMode();
        r_symnum := OpMode(1);  ! -> RG311
        r_symnum := OpMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== present
! rule: arguments of Present
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := Present(v_num);
        r_bool := Present();  ! -> RG311
        r_bool := Present(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== robos
! rule: arguments of RobOS
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := RobOS();
        r_bool := RobOS(1);  ! -> RG311
        r_bool := RobOS(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== runmode
! rule: arguments of RunMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR symnum r_symnum;
    PROC main()
        r_symnum := RunMode();
        r_symnum := RunMode(\Main);
        r_symnum := RunMode(1);  ! -> RG311
        r_symnum := RunMode(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== textget
! rule: arguments of TextGet
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := TextGet(1, 1);
        r_string := TextGet(1);  ! -> RG311
        r_string := TextGet(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== texttabfreetouse
! rule: arguments of TextTabFreeToUse
! source: [K §11, 15]
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TextTabFreeToUse("x");
        r_bool := TextTabFreeToUse();  ! -> RG311
        r_bool := TextTabFreeToUse("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== texttabget
! rule: arguments of TextTabGet
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := TextTabGet("x");
        r_num := TextTabGet();  ! -> RG311
        r_num := TextTabGet("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== texttabinstall
! rule: arguments of TextTabInstall
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TextTabInstall "x";
        TextTabInstall;  ! -> RG311?
        TextTabInstall "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== type
! rule: arguments of Type
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string r_string;
    PROC main()
        r_string := Type(v_num);
        r_string := Type(v_num \BaseName);
        r_string := Type();  ! -> RG311
        r_string := Type(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
