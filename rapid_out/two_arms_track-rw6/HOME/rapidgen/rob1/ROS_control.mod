MODULE ROS_control
    ! The control server: STOP and all that must not wait, on a connection of its own.
    !
    ! Robot "two_arms_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! STOP, PAUSE, SPEED, HEARTBEAT and SIGNAL, which no point delays. On STOP and on a missing
    ! heartbeat this task asks the supervisor, by an interrupt: only one task stops the robot, and
    ! starts it again. Only if that does not answer this task stops it. It may hang in a send.

    CONST string ROS_BUILD_CONTROL := "88e807c4be29";

    LOCAL CONST num PORT := 11001;
    ! s between two looks at what the robot does, and for new clients.
    LOCAL CONST num LOOK_PERIOD := 0.1;
    ! s for the motion server to look at its sockets after a STOP. It waits for bytes for ROS_WAIT, which is less.
    LOCAL CONST num SEEN_TIMEOUT := 0.15;
    ! s: the longest time between heartbeats.
    LOCAL CONST num LONGEST := 3600;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! The other socket already holds the next client.
    LOCAL VAR bool taken_over := FALSE;
    LOCAL VAR bool linked := FALSE;
    LOCAL VAR clock since_look;

    ! The message at hand, by itself.
    LOCAL VAR rawbytes request;
    LOCAL VAR rawbytes answer;

    ! s in which the next heartbeat must come, 0: none is awaited.
    LOCAL VAR num heartbeat := 0;
    LOCAL VAR clock since_heartbeat;
    ! The newest trajectory whose early end was told.
    LOCAL VAR num told_dead := 0;
    LOCAL VAR ROS_progress newest;

    ! Signals that the configuration exposes. They are tied to their names when the task starts;
    ! one that the controller does not have is refused, the others work.
    LOCAL CONST string NAME_1 := "clamp_close";
    LOCAL VAR signaldo signal_1;
    LOCAL VAR bool has_1 := FALSE;
    LOCAL CONST string NAME_2 := "part_present";
    LOCAL VAR signaldi signal_2;
    LOCAL VAR bool has_2 := FALSE;
    LOCAL VAR bool link_ok := FALSE;

    PROC main()
        ROS_start_task ROS_shown_control_1,
            ROS_BUILD_LIMITS = ROS_BUILD_ID AND ROS_BUILD_MESSAGES = ROS_BUILD_ID AND
            ROS_BUILD_SOCKET = ROS_BUILD_ID AND ROS_BUILD_CONTROL = ROS_BUILD_ID;
        ROS_begin_pulse 2;
        ROS_read_limits;
        ROS_speed_of_1 := -1;
        link_signals;
        ROS_listen server, PORT;
        WHILE TRUE DO
            serve client_1, client_2;
            lost_client;
            serve client_2, client_1;
            lost_client;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it is gone, or until a newer one has come on `newcomer`:
    ! whoever may stop the robot must be able to, whatever another client does.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received;

        IF NOT taken_over THEN
            WHILE NOT ROS_accept(server, PORT, client, ROS_WAIT) DO
                ! Nobody, a stranger, or the server socket broke and was opened again.
            ENDWHILE
        ENDIF
        taken_over := FALSE;
        linked := TRUE;
        told_dead := ROS_dead_1;
        ROS_start_clock since_look;
        ROS_part_bytes := 0;
        WHILE linked AND (NOT taken_over) DO
            received := ROS_receive(client, ROS_chunk, patience());
            IF received > 0 THEN
                take_chunk client, received;
            ELSEIF received < 0 THEN
                linked := FALSE;
            ENDIF
            IF linked AND is_late() THEN
                heartbeat := 0;
                ask_stop ROS_REASON_CLIENT_LOST;
            ENDIF
            IF linked tell_end client;
            IF linked AND ClkRead(since_look) >= LOOK_PERIOD THEN
                ROS_start_clock since_look;
                taken_over := ROS_accept(server, PORT, newcomer, 0.001);
            ENDIF
        ENDWHILE
        SocketClose client;
    ERROR
        ! Nothing that a client sends may end this task.
        ErrWrite \W, "ROS: a client was dropped", "Error " + ValToStr(ERRNO) + " while serving it.";
        SocketClose client;
        RETURN;
    ENDPROC

    LOCAL FUNC bool is_late()
        IF heartbeat = 0 RETURN FALSE;
        RETURN ClkRead(since_heartbeat) > heartbeat;
    ENDFUNC

    ! A client whose heartbeats are awaited is gone, or was replaced.
    LOCAL PROC lost_client()
        IF heartbeat > 0 ask_stop ROS_REASON_CLIENT_LOST;
        heartbeat := 0;
    ENDPROC

    ! s to wait for bytes: never beyond the next heartbeat.
    LOCAL FUNC num patience()
        VAR num left;

        IF heartbeat = 0 RETURN LOOK_PERIOD;
        left := heartbeat - ClkRead(since_heartbeat);
        IF left > LOOK_PERIOD RETURN LOOK_PERIOD;
        ! Also one that is due is looked for: it may be here already.
        IF left < 0.002 RETURN 0.002;
        RETURN left;
    ENDFUNC

    LOCAL PROC take_chunk(VAR socketdev client, num received)
        ROS_take_bytes received;
        WHILE linked DO
            TEST ROS_next_frame()
            CASE ROS_FRAME_IN_CHUNK:
                take_request client, ROS_chunk, ROS_frame_at;
            CASE ROS_FRAME_IN_PART:
                take_request client, ROS_part, 1;
            CASE ROS_FRAME_BROKEN:
                linked := FALSE;
            DEFAULT:
                RETURN;
            ENDTEST
        ENDWHILE
    ERROR
        RAISE;
    ENDPROC

    ! The message that begins at byte `at` of `data`. Anything but a request of the right length
    ! breaks the link, unless its type is not known.
    LOCAL PROC take_request(VAR socketdev client, VAR rawbytes data, num at)
        VAR num comm;
        VAR num wanted := 0;

        ClearRawBytes request;
        CopyRawBytes data, at, request, 1 \NoOfBytes:=ROS_frame_length + 4;
        UnpackRawBytes request, 9, comm \IntX:=DINT;
        linked := (comm = ROS_COMM_REQUEST);
        TEST ROS_frame_type
        CASE ROS_MSG_JOINT_TRAJ_PT:
            IF is_whole(ROS_LEN_JOINT_TRAJ_PT) take_stop client;
        CASE ROS_MSG_PAUSE:
            IF is_whole(ROS_LEN_PAUSE) take_pause client;
        CASE ROS_MSG_SPEED:
            IF is_whole(ROS_LEN_SPEED) take_speed client;
        CASE ROS_MSG_HEARTBEAT:
            IF is_whole(ROS_LEN_HEARTBEAT) take_heartbeat client;
        CASE ROS_MSG_SIGNAL:
            IF is_whole(ROS_LEN_SIGNAL) take_signal client;
        CASE ROS_MSG_HELLO:
            linked := ROS_take_hello(request, ROS_frame_length + 4, answer, wanted);
            IF linked send_answer client;
        CASE ROS_MSG_PING:
            IF linked confirm client;
        DEFAULT:
            IF linked THEN
                ROS_pack_reply answer, ROS_frame_type, ROS_REPLY_FAILURE;
                send_answer client;
            ENDIF
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool is_whole(num length)
        linked := linked AND ROS_frame_length = length;
        RETURN linked;
    ENDFUNC

    LOCAL PROC send_answer(VAR socketdev client)
        linked := ROS_send(client, answer);
    ENDPROC

    LOCAL PROC confirm(VAR socketdev client)
        ROS_pack_reply answer, ROS_frame_type, ROS_REPLY_SUCCESS;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Answer that it was done, or why not.
    LOCAL PROC report(VAR socketdev client, num reason)
        IF reason = ROS_REASON_NONE THEN
            confirm client;
            RETURN;
        ENDIF
        ROS_pack_header answer, ROS_HEADER_BYTES + 4, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_FAILURE;
        PackRawBytes reason, answer, 17 \IntX:=DINT;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! STOP is the only point that comes here. The reply comes when the stop is sure to last, and the motion
    ! server counts what comes from now on as sent after it; but it does not wait for that for long.
    LOCAL PROC take_stop(VAR socketdev client)
        VAR num sequence;
        VAR num code := ROS_REPLY_SUCCESS;

        UnpackRawBytes request, 17, sequence \IntX:=DINT;
        linked := (sequence = ROS_SEQ_STOP);
        IF NOT linked RETURN;
        ask_stop ROS_REASON_STOPPED;
        IF NOT answered(ROS_control_asked_1, ROS_control_done_1, ROS_LATE - ROS_SOON) THEN
            code := ROS_REPLY_FAILURE;
        ELSEIF NOT answered(ROS_control_asked_1, ROS_control_seen_1, SEEN_TIMEOUT) THEN
            ! The motion server is still reading. It rejects what it reads before its socket is empty.
        ENDIF
        ROS_pack_reply answer, ROS_frame_type, code;
        send_answer client;
        ! A heartbeat that came meanwhile was not read yet, and is not late for that.
        ROS_start_clock since_heartbeat;
    ERROR
        RAISE;
    ENDPROC

    ! Ask the supervisor for a halt: it stops the robot. Without an answer this task does, and asks
    ! again: the supervisor may have just answered what came before.
    LOCAL PROC ask_stop(num reason)
        ROS_control_reason_1 := reason;
        ROS_control_asked_1 := ROS_next(ROS_control_asked_1);
        IF answered(ROS_control_asked_1, ROS_control_done_1, ROS_SOON) RETURN;
        IF ROS_stopped_alone() ROS_control_asked_1 := ROS_next(ROS_control_asked_1);
    ENDPROC

    ! TRUE when all that was `asked` is `done`, FALSE if it is not in time.
    LOCAL FUNC bool answered(PERS num asked, PERS num done, num seconds)
        FOR try FROM 1 TO 250 * seconds DO
            IF done = asked RETURN TRUE;
            WaitTime 0.004;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    LOCAL PROC take_pause(VAR socketdev client)
        VAR num paused;

        UnpackRawBytes request, 17, paused \IntX:=DINT;
        IF paused <> 0 AND paused <> 1 THEN
            report client, ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        ROS_pause_wanted_1 := (paused = 1);
        ROS_pause_asked_1 := ROS_next(ROS_pause_asked_1);
        IF answered(ROS_pause_asked_1, ROS_pause_done_1, ROS_LATE) THEN
            report client, ROS_pause_refused_1;
        ELSE
            report client, ROS_REASON_INTERNAL;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! The motion task is asked directly: it is the only one that can.
    LOCAL PROC take_speed(VAR socketdev client)
        VAR num percent;

        UnpackRawBytes request, 17, percent \Float4;
        IF NOT (1 <= percent AND percent <= 100) THEN
            report client, ROS_REASON_BAD_VALUE;
        ELSEIF NOT ROS_active() THEN
            report client, ROS_REASON_IDLE;
        ELSE
            ROS_speed_wanted_1 := percent;
            ROS_speed_of_1 := ROS_session_1;
            ROS_speed_asked_1 := ROS_next(ROS_speed_asked_1);
            IF answered(ROS_speed_asked_1, ROS_speed_done_1, ROS_LATE) THEN
                confirm client;
            ELSE
                report client, ROS_REASON_INTERNAL;
            ENDIF
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC take_heartbeat(VAR socketdev client)
        VAR num seconds;

        UnpackRawBytes request, 17, seconds \Float4;
        IF NOT (0 <= seconds AND seconds <= LONGEST) THEN
            report client, ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        heartbeat := seconds;
        ROS_start_clock since_heartbeat;
        ROS_look newest;
        ROS_pack_header answer, 20, ROS_MSG_HEARTBEAT, ROS_COMM_REPLY, ROS_REPLY_SUCCESS;
        PackRawBytes newest.trajectory, answer, 17 \IntX:=DINT;
        PackRawBytes newest.state, answer, 21 \IntX:=DINT;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! STOPPED: where the robot stands after a trajectory has ended early and its path is gone.
    LOCAL PROC tell_end(VAR socketdev client)
        VAR num trajectory;
        VAR num reached := 0;
        VAR jointtarget joints;

        trajectory := ROS_dead_1;
        IF trajectory = told_dead RETURN;
        told_dead := trajectory;
        IF ROS_started_1 = trajectory reached := ROS_reached_1;
        joints := CJointT();
        ROS_pack_topic answer, ROS_LEN_STOPPED, ROS_MSG_STOPPED;
        PackRawBytes trajectory, answer, 17 \IntX:=DINT;
        PackRawBytes reached, answer, 21 \IntX:=DINT;
        PackRawBytes ROS_dead_reason_1 MOD 100, answer, 25 \IntX:=DINT;
        PackRawBytes joints.robax.rax_1 / ROS_DEG, answer, 29 \Float4;
        PackRawBytes joints.robax.rax_2 / ROS_DEG, answer, 33 \Float4;
        PackRawBytes joints.robax.rax_3 / ROS_DEG, answer, 37 \Float4;
        PackRawBytes joints.robax.rax_4 / ROS_DEG, answer, 41 \Float4;
        PackRawBytes joints.robax.rax_5 / ROS_DEG, answer, 45 \Float4;
        PackRawBytes joints.robax.rax_6 / ROS_DEG, answer, 49 \Float4;
        PackRawBytes joints.extax.eax_a / ROS_MM, answer, 53 \Float4;
        PackRawBytes joints.extax.eax_b / ROS_DEG, answer, 57 \Float4;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! SIGNAL: read one, or write it first.
    LOCAL PROC take_signal(VAR socketdev client)
        VAR num index;
        VAR num wish;
        VAR num value;
        VAR num fault;

        UnpackRawBytes request, 17, index \IntX:=DINT;
        UnpackRawBytes request, 21, wish \IntX:=DINT;
        UnpackRawBytes request, 25, value \Float4;
        IF wish <> 0 AND wish <> 1 THEN
            fault := ROS_REASON_BAD_VALUE;
        ELSE
            fault := ROS_REASON_NONE;
            IF wish = 1 fault := write_signal(index, value);
            IF fault = ROS_REASON_NONE fault := read_signal(index, value);
        ENDIF
        IF fault <> ROS_REASON_NONE THEN
            report client, fault;
            RETURN;
        ENDIF
        ROS_pack_header answer, 20, ROS_MSG_SIGNAL, ROS_COMM_REPLY, ROS_REPLY_SUCCESS;
        PackRawBytes index, answer, 17 \IntX:=DINT;
        PackRawBytes value, answer, 21 \Float4;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Write a signal that the configuration lets be written. Gives why not, 0: done.
    LOCAL FUNC num write_signal(num index, num value)
        IF NOT (-ROS_FINITE <= value AND value <= ROS_FINITE) RETURN ROS_REASON_BAD_VALUE;
        TEST index
        CASE 0:
            IF NOT has_1 RETURN ROS_REASON_NO_SIGNAL;
            IF value <> 0 AND value <> 1 RETURN ROS_REASON_BAD_VALUE;
            SetDO signal_1, value;
        CASE 1:
            RETURN ROS_REASON_READ_ONLY;
        DEFAULT:
            RETURN ROS_REASON_NO_SIGNAL;
        ENDTEST
        RETURN ROS_REASON_NONE;
    ERROR
        ! Its unit is not there, or the value is too large for it.
        SkipWarn;
        IF ERRNO = ERR_NORUNUNIT RETURN ROS_REASON_NO_SIGNAL;
        RETURN ROS_REASON_BAD_VALUE;
    ENDFUNC

    ! Read a signal into `value`. Gives why not, 0: done.
    LOCAL FUNC num read_signal(num index, INOUT num value)
        TEST index
        CASE 0:
            IF NOT has_1 RETURN ROS_REASON_NO_SIGNAL;
            value := DOutput(signal_1);
        CASE 1:
            IF NOT has_2 RETURN ROS_REASON_NO_SIGNAL;
            value := DInput(signal_2);
        DEFAULT:
            RETURN ROS_REASON_NO_SIGNAL;
        ENDTEST
        RETURN ROS_REASON_NONE;
    ERROR
        ! Its unit is not there.
        SkipWarn;
        RETURN ROS_REASON_NO_SIGNAL;
    ENDFUNC

    LOCAL PROC link_signals()
        link_ok := TRUE;
        AliasIO NAME_1, signal_1;
        has_1 := link_ok;
        link_ok := TRUE;
        AliasIO NAME_2, signal_2;
        has_2 := link_ok;
    ERROR
        ! No such signal on this controller.
        SkipWarn;
        link_ok := FALSE;
        TRYNEXT;
    ENDPROC
ENDMODULE
