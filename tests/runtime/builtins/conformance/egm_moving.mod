MODULE egm_moving
    ! source: [manual] 3HAC073318: guidance begins and ends in a fine point
    ! robot: irb120
    ! fault: 49911 13
    CONST jointtarget far := [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        EGMActJoint id;
        MoveAbsJ far, v100, z50, tool0;
        EGMRunJoint id, EGM_STOP_HOLD \J1;
    ENDPROC
ENDMODULE
