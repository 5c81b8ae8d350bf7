! rule: arguments of UIAlphaEntry
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_string := UIAlphaEntry();
        r_string := UIAlphaEntry(\Header:="x" \Message:="x" \Wrap \Icon:=1 \InitString:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_string := UIAlphaEntry(\Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \InitString:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_string := UIAlphaEntry(1);  ! -> RG311
        r_string := UIAlphaEntry(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
