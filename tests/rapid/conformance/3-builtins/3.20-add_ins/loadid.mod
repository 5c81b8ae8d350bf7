! rule: arguments of LoadId
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadidnum v_loadidnum;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PERS loaddata p_loaddata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        LoadId v_paridnum, v_loadidnum, p_tooldata;
        LoadId v_paridnum, v_loadidnum, p_tooldata \PayLoad:=p_loaddata \WObj:=p_wobjdata \ConfAngle:=1 \SlowTest \Accuracy:=v_num;
        LoadId;  ! -> RG311?
        LoadId v_paridnum, v_loadidnum, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
