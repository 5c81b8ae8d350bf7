! rule: arguments of SToolTCPCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PROC main()
        SToolTCPCalib v_robtarget, v_robtarget, v_robtarget, v_robtarget, p_tooldata, v_num, v_num;
        SToolTCPCalib;  ! -> RG311?
        SToolTCPCalib v_robtarget, v_robtarget, v_robtarget, v_robtarget, p_tooldata, v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
