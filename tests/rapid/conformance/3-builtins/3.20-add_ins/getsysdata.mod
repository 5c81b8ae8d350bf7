! rule: arguments of GetSysData
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    VAR taskid v_taskid;
    PERS num p_num;
    PROC main()
        GetSysData p_num;
        GetSysData \TaskRef:=v_taskid, p_num \ObjectName:=v_string;
        GetSysData \TaskName:="x", p_num \ObjectName:=v_string;
        GetSysData;  ! -> RG311?
        GetSysData p_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
