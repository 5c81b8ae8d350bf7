! rule: arguments of DefFrame
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR pose r_pose;
    PROC main()
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget);
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget \Origin:=1);
        r_pose := DefFrame(v_robtarget, v_robtarget);  ! -> RG311
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
