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
