! rule: arguments of RelTool
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR robtarget r_robtarget;
    PROC main()
        r_robtarget := RelTool(v_robtarget, 1, 1, 1);
        r_robtarget := RelTool(v_robtarget, 1, 1, 1 \Rx:=1 \Ry:=1 \Rz:=1);
        r_robtarget := RelTool(v_robtarget, 1, 1);  ! -> RG311
        r_robtarget := RelTool(v_robtarget, 1, 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
