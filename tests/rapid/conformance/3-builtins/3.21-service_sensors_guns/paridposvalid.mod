! rule: arguments of ParIdPosValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR bool v_bool_2{2};
    VAR jointtarget v_jointtarget;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PROC main()
        result := ParIdPosValid(v_paridnum, v_jointtarget, v_bool_2);
        result := ParIdPosValid(v_paridnum, v_jointtarget, v_bool_2 \ConfAngle:=v_num);
        result := ParIdPosValid();  ! -> RG311
    ENDPROC
ENDMODULE
