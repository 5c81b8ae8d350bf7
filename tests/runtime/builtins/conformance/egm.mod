!=== egm
MODULE egm
    ! source: [manual] 3HAC073318 2.2 and 5: states, identities, EGMRunJoint without axes, EGMStop
    ! from a trap, ERR_UDPUC_COMM; [code] a public program notes 0 behind EGMReset, 1 behind EGMGetId
    ! source: 1 s without \CommTimeout, one of ABB's engineers (ros-industrial/abb_libegm issue 104)
    ! robot: irb120
    ! expect: 0 0 1 1
    ! expect: nothing to move: 1 after 0
    ! expect: streams: 2 1
    ! expect: stopped in the trap, state 1 after 3
    ! expect: no partner, state 1 after 5
    ! expect: no partner, state 1 after 1
    ! expect: pose, stopped in the trap, state 1 after 2
    ! expect: not awaited: 2 1 1
    ! expect: 0
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;
    VAR intnum ends;
    VAR clock watch;

    PROC main()
        VAR num before;
        before := EGMGetState(id);
        EGMReset id;
        TPWrite ValToStr(before) + " " + ValToStr(EGMGetState(id)) + " " + Taken() + " " + Taken();
        MoveAbsJ start, v1000, fine, tool0;
        EGMSetupUC ROB_1, id, "default", "UCdevice:" \Joint \CommTimeout:=5;
        EGMActJoint id \Tool:=tool0 \WObj:=wobj0 \J1:=near \J6:=near \MaxSpeedDeviation:=20;
        ClkStart watch;
        EGMRunJoint id, EGM_STOP_HOLD \CondTime:=20;
        TPWrite "nothing to move: " + State();
        EGMSetupUC ROB_1, id, "default", "UCdevice";
        Streams;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=5;
        EGMActJoint id \J1:=near;
        CONNECT ends WITH stops;
        ITimer \Single, 3, ends;
        Guided;
        TPWrite "stopped in the trap, state " + State();
        Guided;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        EGMActJoint id \J1:=near;
        Guided;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose \CommTimeout:=5;
        EGMActPose id \Tool:=tool0, tool0.tframe, EGM_FRAME_BASE, tool0.tframe, EGM_FRAME_BASE \x:=near;
        ITimer \Single, 2, ends;
        ClkReset watch;
        ClkStart watch;
        EGMRunPose id, EGM_STOP_RAMP_DOWN \x \rz \CondTime:=1 \RampOutTime:=1;
        TPWrite "pose, stopped in the trap, state " + State();
        NotAwaited;
        EGMReset id;
        TPWrite ValToStr(EGMGetState(id));
    ENDPROC

    FUNC string Taken()
        EGMGetId id;
        RETURN ValToStr(EGMGetState(id));
    ENDFUNC

    FUNC string State()
        RETURN ValToStr(EGMGetState(id)) + " after " + ValToStr(Round(ClkRead(watch)));
    ENDFUNC

    PROC Streams()
        VAR string during;
        EGMStreamStart id \SampleRate:=4;
        during := ValToStr(EGMGetState(id));
        EGMStreamStop id;
        TPWrite "streams: " + during + " " + ValToStr(EGMGetState(id));
    ENDPROC

    PROC Guided()
        ClkReset watch;
        ClkStart watch;
        EGMRunJoint id, EGM_STOP_HOLD \J1 \J6 \CondTime:=20 \RampInTime:=0.05 \PosCorrGain:=1;
    ERROR
        IF ERRNO = ERR_UDPUC_COMM THEN
            TPWrite "no partner, state " + State();
            TRYNEXT;
        ENDIF
    ENDPROC

    PROC NotAwaited()
        VAR string during;
        EGMRunPose id, EGM_STOP_HOLD \NoWaitCond \x;
        during := ValToStr(EGMGetState(id));
        EGMStop id, EGM_STOP_HOLD;
        EGMWaitCond id;
        TPWrite "not awaited: " + during + " " + ValToStr(EGMGetState(id)) + " " + Taken();
    ENDPROC

    TRAP stops
        EGMStop id, EGM_STOP_HOLD;
    ENDTRAP
ENDMODULE
!=== egm_identities
MODULE egm_identities
    ! source: [manual] 3HAC073318: at most four identities; [code] a GoFa with RobotWare 7.21 stops
    ! with "Too many EGM instances"
    ! robot: irb120
    ! expect: four
    ! expect: one was given back
    ! fault: 194911 22
    VAR egmident many{6};

    PROC main()
        FOR i FROM 1 TO 4 DO
            EGMGetId many{i};
        ENDFOR
        TPWrite "four";
        EGMReset many{2};
        Take 5;
        TPWrite "one was given back";
        Take 6;
    ENDPROC

    PROC Take(num i)
        EGMGetId many{i};
    ENDPROC
ENDMODULE
!=== egm_mismatch
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
!=== egm_moving
MODULE egm_moving
    ! source: [manual] 3HAC073318: guidance begins and ends in a fine point
    ! robot: irb120
    ! fault: 194911 13
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
!=== egm_never
MODULE egm_never
    ! source: a GoFa with RobotWare 7.21 stayed in EGMRunJoint for 2 min with 5 s set [code: abb-gofa]
    ! dialect: egm_timeout=never
    ! robot: irb120
    ! expect: 30 and 30
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;
    VAR intnum ends;
    VAR clock watch;
    VAR num first;

    PROC main()
        EGMGetId id;
        CONNECT ends WITH stops;
        first := Lasts();
        TPWrite ValToStr(first) + " and " + ValToStr(Lasts(\logged:=5));
    ENDPROC

    FUNC num Lasts(\num logged)
        IF Present(logged) THEN
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=logged;
        ELSE
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        ENDIF
        EGMActJoint id \J1:=near;
        ITimer \Single, 30, ends;
        ClkReset watch;
        ClkStart watch;
        EGMRunJoint id, EGM_STOP_HOLD \J1;
        RETURN Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_UDPUC_COMM RETURN Round(ClkRead(watch));
    ENDFUNC

    TRAP stops
        EGMStop id, EGM_STOP_HOLD;
    ENDTRAP
ENDMODULE
!=== egm_not_awaited
MODULE egm_not_awaited
    ! source: [manual] 3HAC073318: behind \NoWaitCond a lost partner is always fatal; event 41822
    ! robot: irb120
    ! expect: 2 after 4
    ! fault: 41822 16
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=5;
        EGMActJoint id \J1:=near;
        EGMRunJoint id, EGM_STOP_HOLD \NoWaitCond \J1;
        WaitTime 4;
        TPWrite ValToStr(EGMGetState(id)) + " after 4";
        EGMWaitCond id;
        TPWrite "never";
    ERROR
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== egm_explicit_timeout
MODULE egm_explicit_timeout
    ! source: without \CommTimeout no time is documented [manual 3HAC073318]
    ! dialect: egm_timeout=explicit
    ! robot: irb120
    ! expect: 30 and 5
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;
    VAR intnum ends;
    VAR clock watch;
    VAR num first;

    PROC main()
        EGMGetId id;
        CONNECT ends WITH stops;
        first := Lasts();
        TPWrite ValToStr(first) + " and " + ValToStr(Lasts(\logged:=5));
    ENDPROC

    FUNC num Lasts(\num logged)
        IF Present(logged) THEN
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=logged;
        ELSE
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        ENDIF
        EGMActJoint id \J1:=near;
        ITimer \Single, 30, ends;
        ClkReset watch;
        ClkStart watch;
        EGMRunJoint id, EGM_STOP_HOLD \J1;
        RETURN Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_UDPUC_COMM RETURN Round(ClkRead(watch));
    ENDFUNC

    TRAP stops
        EGMStop id, EGM_STOP_HOLD;
    ENDTRAP
ENDMODULE
!=== egm_tool_without_a_load
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
!=== egm_undefined_load
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
