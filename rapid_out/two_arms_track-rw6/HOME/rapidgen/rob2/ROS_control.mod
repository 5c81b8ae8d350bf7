MODULE ROS_control
    ! The control server: STOP and other requests that must not wait, on their own connection.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! STOP, PAUSE, SPEED, HEARTBEAT and SIGNAL are handled here, so that points never delay
    ! them. On STOP and on a missing heartbeat this task asks the supervisor by an interrupt, because only
    ! one task may stop and restart the robot. If the supervisor does not answer, this task stops the
    ! robot itself.

    CONST string ROS_BUILD_CONTROL := "5273285319d5";

    LOCAL CONST num PORT := 11011;
    ! Time between two checks for new clients and for the end of a trajectory, s.
    LOCAL CONST num POLL_PERIOD := 0.1;
    ! Time for the motion server to check its sockets after STOP, s. It waits for bytes for
    ! ROS_WAIT_TIMEOUT, which is shorter.
    LOCAL CONST num SEEN_TIMEOUT := 0.15;
    ! Shortest wait for bytes, s. A heartbeat that has arrived is read in this time.
    LOCAL CONST num MIN_RECEIVE := 0.002;
    ! Longest time between heartbeats that a client may request, s.
    LOCAL CONST num MAX_HEARTBEAT := 3600;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! TRUE if the other socket already holds the next client to serve; TRUE while the present client is
    ! connected.
    LOCAL VAR bool is_taken_over := FALSE;
    LOCAL VAR bool is_connected := FALSE;
    LOCAL VAR clock clock_poll;

    ! Present request and its reply.
    LOCAL VAR rawbytes request;
    LOCAL VAR rawbytes answer;

    ! Time within which the next heartbeat must arrive, s; 0: none is expected.
    LOCAL VAR num heartbeat_timeout := 0;
    LOCAL VAR clock clock_heartbeat;
    ! Newest trajectory whose early end was reported to the client.
    LOCAL VAR num reported_end := 0;
    LOCAL VAR ROS_progress newest;

    ! Signals of `signals:` in the configuration. This task connects them to their names when it starts.
    ! A signal that the controller does not have is rejected; the others work.
    LOCAL CONST string NAME_1 := "clamp_close";
    LOCAL VAR signaldo signal_1;
    LOCAL VAR bool has_1 := FALSE;
    LOCAL CONST string NAME_2 := "part_present";
    LOCAL VAR signaldi signal_2;
    LOCAL VAR bool has_2 := FALSE;
    LOCAL VAR bool link_ok := FALSE;

    PROC main()
        ROS_start_task ROS_task_build_control_2,
            ROS_BUILD_SERVER = ROS_BUILD_ID AND ROS_BUILD_CONTROL = ROS_BUILD_ID;
        ROS_start_alive_count ROS_ROLE_CONTROL;
        ROS_read_limits;
        ROS_speed_trajectory_2 := -1;
        link_signals;
        ROS_listen server, PORT;
        WHILE TRUE DO
            serve client_1, client_2;
            on_disconnect;
            serve client_2, client_1;
            on_disconnect;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it disconnects or a newer client connects on `newcomer`. A
    ! client that is allowed to stop the robot must be able to do so, whatever another client does.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received;

        IF NOT is_taken_over THEN
            WHILE NOT ROS_accept(server, PORT, client, ROS_WAIT_TIMEOUT) DO
                ! No client came, or one that is not allowed, or the server socket was opened again.
            ENDWHILE
        ENDIF
        is_taken_over := FALSE;
        is_connected := TRUE;
        reported_end := ROS_ended_early_2;
        ROS_start_clock clock_poll;
        ROS_partial_bytes := 0;
        WHILE is_connected AND (NOT is_taken_over) DO
            received := ROS_receive(client, ROS_chunk, receive_timeout());
            IF received > 0 THEN
                handle_chunk client, received;
            ELSEIF received < 0 THEN
                is_connected := FALSE;
            ENDIF
            IF is_connected AND is_heartbeat_late() THEN
                heartbeat_timeout := 0;
                request_stop ROS_REASON_CLIENT_LOST;
            ENDIF
            IF is_connected send_stopped client;
            IF is_connected AND ClkRead(clock_poll) >= POLL_PERIOD THEN
                ROS_start_clock clock_poll;
                is_taken_over := ROS_accept(server, PORT, newcomer, ROS_NO_WAIT);
            ENDIF
        ENDWHILE
        SocketClose client;
    ERROR
        ! No data that a client sends may end this task.
        ErrWrite \W, "ROS: a client was dropped", "Error " + ValToStr(ERRNO) + " while serving it.";
        SocketClose client;
        RETURN;
    ENDPROC

    LOCAL FUNC bool is_heartbeat_late()
        IF heartbeat_timeout = 0 RETURN FALSE;
        RETURN ClkRead(clock_heartbeat) > heartbeat_timeout;
    ENDFUNC

    ! A client that sends heartbeats has disconnected or was replaced.
    LOCAL PROC on_disconnect()
        IF heartbeat_timeout > 0 request_stop ROS_REASON_CLIENT_LOST;
        heartbeat_timeout := 0;
    ENDPROC

    ! Return the time to wait for bytes, s: not longer than until the next heartbeat.
    LOCAL FUNC num receive_timeout()
        VAR num remaining;

        IF heartbeat_timeout = 0 RETURN POLL_PERIOD;
        remaining := heartbeat_timeout - ClkRead(clock_heartbeat);
        IF remaining > POLL_PERIOD RETURN POLL_PERIOD;
        ! Also check for a heartbeat that is due now, because it may have arrived.
        IF remaining < MIN_RECEIVE RETURN MIN_RECEIVE;
        RETURN remaining;
    ENDFUNC

    LOCAL PROC handle_chunk(VAR socketdev client, num received)
        ROS_start_chunk received;
        WHILE is_connected DO
            TEST ROS_next_frame()
            CASE ROS_FRAME_IN_CHUNK:
                handle_request client, ROS_chunk, ROS_frame_at;
            CASE ROS_FRAME_IN_PARTIAL:
                handle_request client, ROS_partial, 1;
            CASE ROS_FRAME_BROKEN:
                is_connected := FALSE;
            DEFAULT:
                RETURN;
            ENDTEST
        ENDWHILE
    ERROR
        RAISE;
    ENDPROC

    ! Handle the message that begins at byte `at` of `data`. A message that is not a request, or has the
    ! wrong length, closes the connection. An unknown type does not.
    LOCAL PROC handle_request(VAR socketdev client, VAR rawbytes data, num at)
        VAR num comm_type;
        VAR num features := 0;

        ClearRawBytes request;
        CopyRawBytes data, at, request, 1 \NoOfBytes:=ROS_frame_length + 4;
        UnpackRawBytes request, 9, comm_type \IntX:=DINT;
        is_connected := (comm_type = ROS_COMM_REQUEST);
        TEST ROS_frame_type
        CASE ROS_MSG_JOINT_TRAJ_PT:
            IF has_length(ROS_LEN_JOINT_TRAJ_PT) handle_stop client;
        CASE ROS_MSG_PAUSE:
            IF has_length(ROS_LEN_PAUSE) handle_pause client;
        CASE ROS_MSG_SPEED:
            IF has_length(ROS_LEN_SPEED) handle_speed client;
        CASE ROS_MSG_HEARTBEAT:
            IF has_length(ROS_LEN_HEARTBEAT) handle_heartbeat client;
        CASE ROS_MSG_SIGNAL:
            IF has_length(ROS_LEN_SIGNAL) handle_signal client;
        CASE ROS_MSG_HELLO:
            is_connected := ROS_handle_hello(request, ROS_frame_length + 4, answer, features);
            IF is_connected send_answer client;
        CASE ROS_MSG_PING:
            IF is_connected send_success client;
        DEFAULT:
            IF is_connected THEN
                ROS_pack_reply answer, ROS_frame_type, ROS_REPLY_FAILURE;
                send_answer client;
            ENDIF
        ENDTEST
    ERROR
        RAISE;
    ENDPROC

    LOCAL FUNC bool has_length(num length)
        is_connected := is_connected AND ROS_frame_length = length;
        RETURN is_connected;
    ENDFUNC

    LOCAL PROC send_answer(VAR socketdev client)
        is_connected := ROS_send(client, answer);
    ENDPROC

    LOCAL PROC send_success(VAR socketdev client)
        ROS_pack_reply answer, ROS_frame_type, ROS_REPLY_SUCCESS;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Reply with success, or with the reason for a failure.
    LOCAL PROC send_result(VAR socketdev client, num reason)
        IF reason = ROS_REASON_NONE THEN
            send_success client;
            RETURN;
        ENDIF
        ROS_pack_header answer, ROS_HEADER_BYTES + 4, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_FAILURE;
        PackRawBytes reason, answer, 17 \IntX:=DINT;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Handle STOP, the only point that is valid on this port. The reply is sent when the stop is in
    ! force, and the motion server regards everything that it receives from now on as newer. The reply
    ! does not wait for the motion server longer than SEEN_TIMEOUT.
    LOCAL PROC handle_stop(VAR socketdev client)
        VAR num sequence;
        VAR num code := ROS_REPLY_SUCCESS;

        UnpackRawBytes request, 17, sequence \IntX:=DINT;
        is_connected := (sequence = ROS_SEQ_STOP);
        IF NOT is_connected RETURN;
        request_stop ROS_REASON_STOPPED;
        IF NOT wait_answered(ROS_control_asked_2, ROS_control_done_2, ROS_REPLY_TIMEOUT - ROS_STOP_TIMEOUT) THEN
            code := ROS_REPLY_FAILURE;
        ELSEIF NOT wait_answered(ROS_control_asked_2, ROS_control_stops_seen_2, SEEN_TIMEOUT) THEN
            ! The motion server is still reading. It rejects what it reads before its socket is empty.
        ENDIF
        ROS_pack_reply answer, ROS_frame_type, code;
        send_answer client;
        ! A heartbeat that has arrived meanwhile is still unread, so it is not late.
        ROS_start_clock clock_heartbeat;
    ERROR
        RAISE;
    ENDPROC

    ! Ask the supervisor for a halt. Without an answer this task stops the robot and repeats the
    ! request, because the supervisor may have answered just an earlier one.
    LOCAL PROC request_stop(num reason)
        ROS_control_reason_2 := reason;
        IF reason <> ROS_REASON_CLIENT_LOST ROS_control_commands_2 := ROS_next_count(ROS_control_commands_2);
        ROS_control_asked_2 := ROS_next_count(ROS_control_asked_2);
        IF wait_answered(ROS_control_asked_2, ROS_control_done_2, ROS_STOP_TIMEOUT) RETURN;
        IF ROS_fallback_stop() ROS_control_asked_2 := ROS_next_count(ROS_control_asked_2);
    ENDPROC

    ! Wait until `done` is equal to `asked`. Return FALSE if this takes longer than `seconds`.
    LOCAL FUNC bool wait_answered(PERS num asked, PERS num done, num seconds)
        FOR try FROM 1 TO ROS_ANSWER_CHECKS * seconds DO
            IF done = asked RETURN TRUE;
            WaitTime ROS_ANSWER_PERIOD;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    LOCAL PROC handle_pause(VAR socketdev client)
        VAR num paused;

        UnpackRawBytes request, 17, paused \IntX:=DINT;
        IF paused <> 0 AND paused <> 1 THEN
            send_result client, ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        ROS_pause_on_2 := (paused = 1);
        ROS_pause_asked_2 := ROS_next_count(ROS_pause_asked_2);
        IF wait_answered(ROS_pause_asked_2, ROS_pause_done_2, ROS_REPLY_TIMEOUT) THEN
            send_result client, ROS_pause_refused_2;
        ELSE
            send_result client, ROS_REASON_INTERNAL;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! Ask the motion task directly, because only the motion task can change its speed.
    LOCAL PROC handle_speed(VAR socketdev client)
        VAR num percent;

        UnpackRawBytes request, 17, percent \Float4;
        IF NOT (1 <= percent AND percent <= 100) THEN
            send_result client, ROS_REASON_BAD_VALUE;
        ELSEIF NOT ROS_is_active() THEN
            send_result client, ROS_REASON_IDLE;
        ELSE
            ROS_speed_percent_2 := percent;
            ROS_speed_trajectory_2 := ROS_active_trajectory_2;
            ROS_speed_asked_2 := ROS_next_count(ROS_speed_asked_2);
            IF wait_answered(ROS_speed_asked_2, ROS_speed_done_2, ROS_REPLY_TIMEOUT) THEN
                send_success client;
            ELSE
                send_result client, ROS_REASON_INTERNAL;
            ENDIF
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC handle_heartbeat(VAR socketdev client)
        VAR num seconds;

        UnpackRawBytes request, 17, seconds \Float4;
        IF NOT (0 <= seconds AND seconds <= MAX_HEARTBEAT) THEN
            send_result client, ROS_REASON_BAD_VALUE;
            RETURN;
        ENDIF
        heartbeat_timeout := seconds;
        ROS_start_clock clock_heartbeat;
        ROS_read_progress newest;
        ROS_pack_header answer, 20, ROS_MSG_HEARTBEAT, ROS_COMM_REPLY, ROS_REPLY_SUCCESS;
        PackRawBytes newest.trajectory, answer, 17 \IntX:=DINT;
        PackRawBytes newest.state, answer, 21 \IntX:=DINT;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Send STOPPED with the position of the robot after a trajectory has ended early and its path was
    ! cleared.
    LOCAL PROC send_stopped(VAR socketdev client)
        VAR num trajectory;
        VAR num reached := 0;
        VAR jointtarget joints;

        trajectory := ROS_ended_early_2;
        IF trajectory = reported_end RETURN;
        reported_end := trajectory;
        IF ROS_started_trajectory_2 = trajectory reached := ROS_reached_2;
        joints := CJointT();
        ROS_pack_topic answer, ROS_LEN_STOPPED, ROS_MSG_STOPPED;
        PackRawBytes trajectory, answer, 17 \IntX:=DINT;
        PackRawBytes reached, answer, 21 \IntX:=DINT;
        PackRawBytes ROS_ended_early_reason_2 MOD 100, answer, 25 \IntX:=DINT;
        PackRawBytes joints.robax.rax_1 / ROS_DEG, answer, 29 \Float4;
        PackRawBytes joints.robax.rax_2 / ROS_DEG, answer, 33 \Float4;
        PackRawBytes joints.robax.rax_3 / ROS_DEG, answer, 37 \Float4;
        PackRawBytes joints.robax.rax_4 / ROS_DEG, answer, 41 \Float4;
        PackRawBytes joints.robax.rax_5 / ROS_DEG, answer, 45 \Float4;
        PackRawBytes joints.robax.rax_6 / ROS_DEG, answer, 49 \Float4;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Handle SIGNAL: read a signal, or write it and read it back.
    LOCAL PROC handle_signal(VAR socketdev client)
        VAR num index;
        VAR num access;
        VAR num value;
        VAR num fault;

        UnpackRawBytes request, 17, index \IntX:=DINT;
        UnpackRawBytes request, 21, access \IntX:=DINT;
        UnpackRawBytes request, 25, value \Float4;
        IF access <> 0 AND access <> 1 THEN
            fault := ROS_REASON_BAD_VALUE;
        ELSE
            fault := ROS_REASON_NONE;
            IF access = 1 fault := write_signal(index, value);
            IF fault = ROS_REASON_NONE fault := read_signal(index, value);
        ENDIF
        IF fault <> ROS_REASON_NONE THEN
            send_result client, fault;
            RETURN;
        ENDIF
        ROS_pack_header answer, 20, ROS_MSG_SIGNAL, ROS_COMM_REPLY, ROS_REPLY_SUCCESS;
        PackRawBytes index, answer, 17 \IntX:=DINT;
        PackRawBytes value, answer, 21 \Float4;
        send_answer client;
    ERROR
        RAISE;
    ENDPROC

    ! Write a signal whose `access` is write. Return 0 or the reason for the failure.
    LOCAL FUNC num write_signal(num index, num value)
        IF NOT (-ROS_MAX_FINITE <= value AND value <= ROS_MAX_FINITE) RETURN ROS_REASON_BAD_VALUE;
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
        ! Its I/O unit does not exist or the value is too large for it.
        SkipWarn;
        IF ERRNO = ERR_NORUNUNIT RETURN ROS_REASON_NO_SIGNAL;
        RETURN ROS_REASON_BAD_VALUE;
    ENDFUNC

    ! Read a signal into `value`. Return 0 or the reason for the failure.
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
        ! Its I/O unit does not exist.
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
        ! The controller has no such signal.
        SkipWarn;
        link_ok := FALSE;
        TRYNEXT;
    ENDPROC

ENDMODULE
