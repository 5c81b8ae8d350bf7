! rule: arguments of IsCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR bool result;
    VAR taskid v_taskid;
    PROC main()
        result := IsCyclicBool(p_bool);
        result := IsCyclicBool(p_bool \TaskRef:=v_taskid);
        result := IsCyclicBool();  ! -> RG311
    ENDPROC
ENDMODULE
