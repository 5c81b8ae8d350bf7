MODULE egm_undefined_load
    ! source: event 41438 at EGMActJoint with a load of 0 kg (ros-industrial/abb_libegm, issue 73)
    ! robot: irb120
    ! fault: 41438 13
    CONST egm_minmax near := [-0.5, 0.5];
    PERS loaddata nothing := [0, [0, 0, 0], [1, 0, 0, 0], 0, 0, 0];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        EGMActJoint id \TLoad:=load0 \J1:=near;
        EGMActJoint id \TLoad:=nothing \J1:=near;
    ERROR
        TRYNEXT;
    ENDPROC
ENDMODULE
