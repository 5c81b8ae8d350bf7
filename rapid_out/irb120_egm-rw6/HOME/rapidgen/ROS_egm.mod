MODULE ROS_egm
    ! Externally guided motion (EGM): a session in which another program guides the robot.
    !
    ! Robot "irb120_egm-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! The client requests a session on the control port. The motion server starts it under a number of its
    ! own, like a trajectory, so sessions and trajectories exclude each other and end for the same
    ! reasons. The motion task then waits in EGMRunJoint, while the controller exchanges datagrams with
    ! 192.168.125.20:6510 every 4 ms.
    !
    ! A session ends by EGMStop in a trap: on request of the client, on STOP, without a heartbeat, and if
    ! the supervisor has ended. The robot then stays where it is. EGMReset follows on every path, because
    ! identities that were not reset are lost until the controller restarts.

    CONST string ROS_BUILD_EGM := "e0ee62753484";

    ! UdpUc device (SIO) and external motion interface data (MOC) of this build.
    LOCAL CONST string DEVICE := "ROS_EGM";
    LOCAL CONST string DEVICE_PATH := "/SIO/COM_TRP/ROS_EGM";
    LOCAL CONST string PROFILE_PATH := "/MOC/EXT_MOTION_DATA/ROS_EGM";
    LOCAL CONST string ADDRESS := "192.168.125.20";
    LOCAL CONST num UDP_PORT := 6510;
    ! Limits that the controller enforces: distance of each axis from where the session begins, deg, and
    ! its speed, deg/s.
    LOCAL CONST num MAX_DEVIATION := 20;
    LOCAL CONST num MAX_SPEED := 45;
    ! Bandwidth of the low-pass filter, Hz, and time between two datagrams, ms.
    LOCAL CONST num FILTER := 20;
    LOCAL CONST num SAMPLE_TIME := 4;
    ! Time at the beginning until the robot follows completely, and time in which it stops, s.
    LOCAL CONST num RAMP_IN := 0.5;
    LOCAL CONST num RAMP_OUT := 0.2;
    ! A session ends by itself when all axes have been this near to their targets (deg) for IDLE_TIMEOUT
    ! (s). The range limits nothing. It is narrow, so that a slow motion is not taken for a rest: a moving
    ! axis is behind its target by its speed divided by the gain.
    LOCAL CONST egm_minmax AT_TARGET := [-0.1,0.1];
    LOCAL CONST num IDLE_TIMEOUT := 600;
    ! Time without a datagram after which the controller itself ends a session, s. Some controllers do
    ! not, so the heartbeat below does not depend on it.
    LOCAL CONST num COMM_TIMEOUT := 1;
    ! Time between two checks of a session, s. An interrupt that came before EGMRunJoint is noticed by
    ! the next check.
    LOCAL CONST num CHECK_PERIOD := 0.1;
    ! Time after which EGMStop is repeated if the session has not ended, s. A real robot stops in 1.1 s.
    LOCAL CONST num REPEAT_DELAY := 2;

    LOCAL VAR egmident session;
    LOCAL VAR intnum int_control;
    LOCAL VAR intnum int_server;
    LOCAL VAR intnum int_end;
    LOCAL VAR intnum int_check;
    ! TRUE while main is in EGMRunJoint: then a trap may end it.
    VAR bool ROS_is_guiding := FALSE;
    ! TRUE after EGMStop, and the time since then.
    LOCAL VAR bool is_stopped := FALSE;
    LOCAL VAR clock clock_stop;
    ! TRUE if the heartbeat was missing.
    LOCAL VAR bool is_lost := FALSE;
    ! Reason why the session failed (ROS_REASON_...).
    LOCAL VAR num fault := 0;
    ! Counts of requests for a stop when the session began.
    LOCAL VAR num control_asked := 0;
    LOCAL VAR num server_asked := 0;

    ! ROS_run calls this at its start. A session before PP to main is over.
    PROC ROS_prepare_egm()
        ROS_is_guiding := FALSE;
        EGMReset session;
        ROS_egm_end_done := ROS_egm_end_asked;
        ROS_egm_ready := is_configured();
    ENDPROC

    ! Return TRUE if the controller has the device and the profile of this build. Without them EGMSetupUC
    ! would stop the program.
    LOCAL FUNC bool is_configured()
        VAR string text;
        VAR num number;

        ReadCfgData PROFILE_PATH, "ramp_time", number;
        ReadCfgData DEVICE_PATH, "RemotePortNumber", number;
        IF number <> UDP_PORT RETURN FALSE;
        ReadCfgData DEVICE_PATH, "RemoteAdress", text;
        RETURN text = ADDRESS;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC

    ! Execute a session. The robot stands at a stop point. Return 0 if the session has ended as requested
    ! or at its target, else the reason for its end.
    FUNC num ROS_guide()
        fault := ROS_REASON_NONE;
        is_stopped := FALSE;
        is_lost := FALSE;
        control_asked := ROS_control_asked;
        server_asked := ROS_stop_asked;
        run_session;
        IF is_lost fault := ROS_REASON_CLIENT_LOST;
        RETURN fault;
    ENDFUNC

    LOCAL PROC run_session()
        WaitRob \InPos;
        EGMReset session;
        EGMGetId session;
        EGMSetupUC ROB_1, session, DEVICE, DEVICE \Joint \CommTimeout:=COMM_TIMEOUT;
        EGMActJoint session \Tool:=tool0
            \J1:=AT_TARGET \J2:=AT_TARGET \J3:=AT_TARGET \J4:=AT_TARGET \J5:=AT_TARGET \J6:=AT_TARGET \LpFilter:=FILTER
            \SampleRate:=SAMPLE_TIME \MaxPosDeviation:=MAX_DEVIATION \MaxSpeedDeviation:=MAX_SPEED;
        connect_interrupts;
        ROS_is_guiding := TRUE;
        ! A stop that came before this must not wait for the first check.
        IF NOT must_end() EGMRunJoint session, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=IDLE_TIMEOUT
            \RampInTime:=RAMP_IN \PosCorrGain:=1;
        end_session;
        WaitRob \ZeroSpeed;
    ERROR
        ! Not RETRY: a session that has failed needs a new request.
        SkipWarn;
        fault := ROS_REASON_MOTION_ERROR;
        IF ERRNO = ERR_UDPUC_COMM fault := ROS_REASON_CLIENT_LOST;
        end_session;
        RETURN;
    UNDO
        EGMReset session;
    ENDPROC

    LOCAL PROC end_session()
        ROS_is_guiding := FALSE;
        IDelete int_control;
        IDelete int_server;
        IDelete int_end;
        IDelete int_check;
        EGMReset session;
        ROS_egm_stopped := ROS_active_trajectory;
        ROS_egm_end_done := ROS_egm_end_asked;
    ENDPROC

    ! The traps listen to the servers themselves, so that a stop does not wait for the supervisor.
    LOCAL PROC connect_interrupts()
        IDelete int_control;
        CONNECT int_control WITH on_request;
        IPers ROS_control_asked, int_control;
        IDelete int_server;
        CONNECT int_server WITH on_request;
        IPers ROS_stop_asked, int_server;
        IDelete int_end;
        CONNECT int_end WITH on_request;
        IPers ROS_egm_end_asked, int_end;
        IDelete int_check;
        CONNECT int_check WITH on_request;
        ITimer CHECK_PERIOD, int_check;
    ENDPROC

    LOCAL TRAP on_request
        ROS_check_session;
    ENDTRAP

    ! Stop the session if it must end. Traps of the motion task call this.
    PROC ROS_check_session()
        IF (NOT ROS_is_guiding) OR (NOT must_end()) RETURN;
        IF is_stopped AND ROS_elapsed_seconds(clock_stop) < REPEAT_DELAY RETURN;
        ! Before the run has begun, EGMStop has no effect: the next check repeats it.
        IF EGMGetState(session) <= EGM_STATE_CONNECTED RETURN;
        EGMStop session, EGM_STOP_HOLD \RampOutTime:=RAMP_OUT;
        is_stopped := TRUE;
        ROS_start_clock clock_stop;
        ROS_egm_stopped := ROS_active_trajectory;
        ROS_egm_end_done := ROS_egm_end_asked;
    ERROR
        ! Without an answer the supervisor stops the robot.
        SkipWarn;
        RETURN;
    ENDPROC

    LOCAL FUNC bool must_end()
        IF is_stopped RETURN TRUE;
        IF ROS_egm_end_asked <> ROS_egm_end_done RETURN TRUE;
        IF ROS_abort <> ROS_abort_done RETURN TRUE;
        IF ROS_control_asked <> control_asked OR ROS_stop_asked <> server_asked RETURN TRUE;
        IF NOT ROS_is_active() RETURN TRUE;
        RETURN ROS_supervisor_missing;
    ENDFUNC
ENDMODULE
