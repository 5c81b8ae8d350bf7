! rule: arguments of UINumEntry
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_num := UINumEntry();
        r_num := UINumEntry(\Header:="x" \Message:="x" \Wrap \Icon:=1 \InitValue:=1 \MinValue:=1 \MaxValue:=1 \AsInteger \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UINumEntry(\Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \InitValue:=1 \MinValue:=1 \MaxValue:=1 \AsInteger \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UINumEntry(1);  ! -> RG311
        r_num := UINumEntry(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
