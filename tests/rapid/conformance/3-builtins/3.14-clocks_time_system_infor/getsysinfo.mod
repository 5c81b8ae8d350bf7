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
