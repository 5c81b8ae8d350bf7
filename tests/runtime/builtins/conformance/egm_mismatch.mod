MODULE egm_mismatch
    ! source: [manual] 3HAC073318: EGMActPose and EGMRunJoint do not belong together, event 41826
    ! robot: irb120
    ! fault: 41826 13
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose;
        EGMActPose id, tool0.tframe, EGM_FRAME_BASE, tool0.tframe, EGM_FRAME_BASE \x:=near;
        ! An error without a number: no handler gets it.
        EGMRunJoint id, EGM_STOP_HOLD \J1;
    ERROR
        TRYNEXT;
    ENDPROC
ENDMODULE
