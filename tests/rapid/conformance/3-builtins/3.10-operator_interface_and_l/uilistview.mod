! rule: arguments of UIListView
! source: [manual] 3HAC050917
MODULE Demo
    VAR listitem v_listitem_array{2};
    VAR num r_num;
    VAR btnres v_btnres;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_num := UIListView(v_listitem_array);
        r_num := UIListView(\Result:=v_btnres \Header:="x", v_listitem_array \Buttons:=1 \Icon:=1 \DefaultIndex:=1 \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UIListView(\Result:=v_btnres \Header:="x", v_listitem_array \BtnArray:=v_string_array \Icon:=1 \DefaultIndex:=1 \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UIListView();  ! -> RG311
        r_num := UIListView(v_listitem_array \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
