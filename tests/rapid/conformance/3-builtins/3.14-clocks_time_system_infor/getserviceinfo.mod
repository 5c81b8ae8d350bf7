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
