! rule: arguments of UIMessageBox
! source: [manual] 3HAC050917
MODULE Demo
    VAR btnres r_btnres;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_btnres := UIMessageBox();
        r_btnres := UIMessageBox(\Header:="x" \Message:="x" \Wrap \Buttons:=1 \DefaultBtn:=1 \Icon:=1 \Image:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_btnres := UIMessageBox(\Header:="x" \MsgArray:=v_string_array \Wrap \BtnArray:=v_string_array \DefaultBtn:=1 \Icon:=1 \Image:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_btnres := UIMessageBox(1);  ! -> RG311
        r_btnres := UIMessageBox(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
