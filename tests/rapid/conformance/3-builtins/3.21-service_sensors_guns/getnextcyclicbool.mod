! rule: arguments of GetNextCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := GetNextCyclicBool(v_num, v_string);
        result := GetNextCyclicBool();  ! -> RG311
    ENDPROC
ENDMODULE
