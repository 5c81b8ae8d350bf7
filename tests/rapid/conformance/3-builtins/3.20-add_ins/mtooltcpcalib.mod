! rule: arguments of MToolTCPCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    VAR num v_num;
    PERS tooldata p_tooldata;
    PROC main()
        MToolTCPCalib v_jointtarget, v_jointtarget, v_jointtarget, v_jointtarget, p_tooldata, v_num, v_num;
        MToolTCPCalib;  ! -> RG311?
        MToolTCPCalib v_jointtarget, v_jointtarget, v_jointtarget, v_jointtarget, p_tooldata, v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
