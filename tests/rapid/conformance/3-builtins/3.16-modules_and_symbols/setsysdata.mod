! rule: arguments of SetSysData
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PROC main()
        SetSysData p_num;
        SetSysData p_num \ObjectName:="x";
        SetSysData;  ! -> RG311?
        SetSysData p_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
