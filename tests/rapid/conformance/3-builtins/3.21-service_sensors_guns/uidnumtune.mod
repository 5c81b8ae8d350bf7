! rule: arguments of UIDnumTune
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR dnum result;
    VAR dnum v_dnum;
    VAR errnum v_errnum;
    VAR icondata v_icondata;
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    VAR string v_string;
    PROC main()
        result := UIDnumTune(v_dnum, v_dnum);
        result := UIDnumTune(\Header:=v_string \Message:=v_string \Wrap \Icon:=v_icondata, v_dnum, v_dnum \MinValue:=v_dnum \MaxValue:=v_dnum \MaxTime:=v_num \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        result := UIDnumTune();  ! -> RG311
    ENDPROC
ENDMODULE
