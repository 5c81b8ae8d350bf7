MODULE egm_tool_without_a_load
    ! source: event 41438 at EGMActJoint (ros-industrial/abb_libegm, issue 73); of a tool [mem]
    ! robot: irb120
    ! fault: 41438 12
    CONST egm_minmax near := [-0.5, 0.5];
    PERS tooldata held := [TRUE, [[0, 0, 0], [1, 0, 0, 0]], [-1, [0, 0, 0], [1, 0, 0, 0], 0, 0, 0]];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose;
        EGMActPose id \Tool:=held, tool0.tframe, EGM_FRAME_BASE, tool0.tframe, EGM_FRAME_BASE \x:=near;
    ENDPROC
ENDMODULE
