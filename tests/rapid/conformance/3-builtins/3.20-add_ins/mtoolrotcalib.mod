! rule: arguments of MToolRotCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    PROC main()
        MToolRotCalib v_jointtarget, v_jointtarget, p_tooldata;
        MToolRotCalib v_jointtarget, v_jointtarget \XPos:=v_jointtarget, p_tooldata;
        MToolRotCalib;  ! -> RG311?
        MToolRotCalib v_jointtarget, v_jointtarget, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
