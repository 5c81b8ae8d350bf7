! rule: arguments of GetTaskName
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    VAR num v_num;
    PROC main()
        r_string := GetTaskName();
        r_string := GetTaskName(\TaskNo:=v_num \MecTaskNo:=v_num);
        r_string := GetTaskName(1);  ! -> RG311
        r_string := GetTaskName(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
