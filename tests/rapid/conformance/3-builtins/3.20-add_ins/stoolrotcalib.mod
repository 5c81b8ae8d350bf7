! rule: arguments of SToolRotCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PROC main()
        SToolRotCalib v_robtarget, v_robtarget, v_robtarget, p_tooldata;
        SToolRotCalib;  ! -> RG311?
        SToolRotCalib v_robtarget, v_robtarget, v_robtarget, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
