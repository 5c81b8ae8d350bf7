! rule: arguments of TPReadNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    PROC main()
        TPReadNum v_num, "x";
        TPReadNum v_num, "x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo;
        TPReadNum v_num;  ! -> RG311
        TPReadNum v_num, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
