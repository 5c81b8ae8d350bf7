MODULE ROS_stateServer
    ! The state server: JOINT and STATUS at a fixed rate.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! This task serves several clients at once: a program and its observers. All clients get the values
    ! of one moment, and no other task waits for this one. A client that does not read would block the
    ! sends to the other clients, so a send that takes too long is ended and its client is disconnected.

    CONST string ROS_BUILD_STATE_SERVER := "5273285319d5";

    LOCAL CONST num PORT := 11012;
    ! Time between two messages, s, and messages per second (`state_period` of the configuration).
    LOCAL CONST num SEND_PERIOD := 0.1;
    LOCAL CONST num SEND_RATE := 10;
    ! Limit of a clock, s: a num (a 32-bit float) up to this value still resolves 0.1 ms.
    LOCAL CONST num CLOCK_LIMIT := 1000;
    ! Number of sockets: one more than clients served, so that a new client can always connect.
    LOCAL CONST num SLOTS := 4;
    ! Time between two checks of the clients' requests, s. Every second check also looks for new
    ! clients.
    LOCAL CONST num POLL_PERIOD := 0.1;
    ! Period of the alarm, s. A send that lasts from one alarm to the next is ended.
    LOCAL CONST num SEND_TIMEOUT := 0.1;
    ! An axis that has moved by less than this since the last message stands still, deg or mm. It is
    ! larger than the noise of a sensor.
    LOCAL CONST num STANDSTILL_TOL := 0.05;
    ! Time for which the controller's signal for motion counts while no axis moves, s. A signal that is
    ! no longer driven would otherwise report motion for ever.
    LOCAL CONST num HOLD_TIME := 10;
    ! Largest number of controller events that wait to be sent.
    LOCAL CONST num MAX_EVENTS := 16;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client{SLOTS};
    ! For each socket: TRUE if it serves a client, and the features of that client (bits
    ! ROS_FEATURE_...).
    LOCAL VAR bool is_served{SLOTS};
    LOCAL VAR num features{SLOTS};
    LOCAL VAR num clients := 0;
    ! Socket of the client that connected last.
    LOCAL VAR num newest_slot := 1;
    LOCAL VAR bool progress_enabled := FALSE;
    LOCAL VAR bool feedback_enabled := FALSE;
    LOCAL VAR bool accept_due := FALSE;
    LOCAL VAR clock clock_poll;

    ! JOINT and STATUS; optional messages; and all of them for one client.
    LOCAL VAR rawbytes state;
    LOCAL VAR rawbytes progress;
    LOCAL VAR rawbytes feedback;
    LOCAL VAR rawbytes message;
    LOCAL VAR num message_features := 0;
    LOCAL VAR num message_bytes := 0;

    ! A message is due at ticks / SEND_RATE + offset on the active clock. Adding up periods in a 32-bit
    ! float would drift. The other clock is started when this one reaches its limit.
    LOCAL VAR clock schedule{2};
    LOCAL VAR num active_clock := 1;
    LOCAL VAR num ticks := 0;
    LOCAL VAR num offset := 0;
    ! Time by which the clock had exceeded CLOCK_LIMIT when it was replaced, s. The time stamps of
    ! feedback thus restart exactly at CLOCK_LIMIT.
    LOCAL VAR num overrun := 0;
    LOCAL VAR num stamp := 0;
    LOCAL VAR num last_sent_stamp := 0;

    LOCAL VAR ROS_progress newest;
    ! Values of the last message, so that a movement between two messages is also reported.
    LOCAL VAR num last_sent_started := 0;
    LOCAL VAR jointtarget last_sent_joints;
    ! Remaining time for which the signal for motion counts, s; 0 until the signal has reported a
    ! standstill.
    LOCAL VAR num hold_seconds := 0;

    ! Send in progress: its socket (0: none) and its number; and the send that the last alarm has found.
    LOCAL VAR intnum int_alarm;
    LOCAL VAR num sending_slot := 0;
    LOCAL VAR num send_count := 0;
    LOCAL VAR num suspect_send := -1;

    ! Events between the trap, which writes them, and main, which reads them.
    LOCAL VAR intnum int_event;
    LOCAL VAR bool events_enabled := FALSE;
    LOCAL VAR num domains{MAX_EVENTS};
    LOCAL VAR num numbers{MAX_EVENTS};
    LOCAL VAR num types{MAX_EVENTS};
    LOCAL VAR string titles{MAX_EVENTS};
    LOCAL VAR string upper_texts{MAX_EVENTS};
    LOCAL VAR string lower_texts{MAX_EVENTS};
    LOCAL VAR num events_written := 0;
    LOCAL VAR num events_read := 0;
    LOCAL VAR num events_lost := 0;

    PROC main()
        ROS_start_task ROS_task_build_state_2,
            ROS_BUILD_SERVER = ROS_BUILD_ID AND ROS_BUILD_STATE_SERVER = ROS_BUILD_ID;
        ROS_start_alive_count ROS_ROLE_STATE;
        ROS_read_limits;
        ROS_init_state state;
        ROS_pack_topic progress, ROS_LEN_PROGRESS, ROS_MSG_PROGRESS;
        ROS_init_feedback feedback;
        ROS_listen server, PORT;
        WHILE TRUE DO
            IF clients = 0 wait_for_client;
            send_state;
            ! Serve the clients in the nearest period.
            IF ClkRead(clock_poll) > POLL_PERIOD - SEND_PERIOD / 2 serve_clients;
            wait_for_period;
        ENDWHILE
    ERROR
        SkipWarn;
        TRYNEXT;
    ENDPROC

    LOCAL PROC wait_for_client()
        WHILE clients = 0 DO
            IF ROS_standing() = ROS_TRI_TRUE hold_seconds := HOLD_TIME;
            accept_client ROS_WAIT_TIMEOUT;
        ENDWHILE
        ticks := 0;
        offset := 0;
        ROS_start_clock schedule{active_clock};
        ROS_start_clock clock_poll;
        last_sent_started := ROS_started_trajectory_2;
        last_sent_joints := CJointT();
    ENDPROC

    ! Accept a new client, if one connects within `seconds`.
    LOCAL PROC accept_client(num seconds)
        VAR num slot;

        slot := free_slot();
        IF NOT ROS_accept(server, PORT, client{slot}, seconds) RETURN;
        is_served{slot} := TRUE;
        clients := clients + 1;
        ! The newest client is served in place of the one before it. The first clients are not
        ! disturbed.
        IF clients = SLOTS drop_client newest_slot;
        newest_slot := slot;
    ENDPROC

    LOCAL FUNC num free_slot()
        FOR slot FROM 1 TO SLOTS - 1 DO
            IF NOT is_served{slot} RETURN slot;
        ENDFOR
        RETURN SLOTS;
    ENDFUNC

    LOCAL PROC drop_client(num slot)
        SocketClose client{slot};
        is_served{slot} := FALSE;
        features{slot} := 0;
        clients := clients - 1;
        update_subscriptions;
    ENDPROC

    ! Send one JOINT, one STATUS and the requested features to each client.
    LOCAL PROC send_state()
        VAR jointtarget joints;
        VAR num code := 0;
        VAR num in_error := ROS_TRI_FALSE;
        VAR num in_motion := ROS_TRI_FALSE;
        VAR num possible := ROS_TRI_FALSE;

        joints := CJointT();
        stamp := ClkRead(schedule{active_clock} \HighRes) + overrun;
        IF stamp >= CLOCK_LIMIT stamp := stamp - CLOCK_LIMIT;
        ROS_pack_joints state, joints;

        ROS_read_progress newest;
        IF newest.state = ROS_TRAJ_REFUSED OR newest.state = ROS_TRAJ_FAILED in_error := ROS_TRI_TRUE;
        IF ROS_controller_error() = ROS_TRI_TRUE in_error := ROS_TRI_TRUE;
        IF feedback_enabled pack_feedback joints;
        IF is_moving(joints) in_motion := ROS_TRI_TRUE;
        IF is_possible() possible := ROS_TRI_TRUE;
        IF in_error = ROS_TRI_TRUE code := newest.code;
        IF ROS_supervisor_missing OR ROS_not_ready_2 = ROS_REASON_TASK_ENDED THEN
            in_error := ROS_TRI_TRUE;
            code := ROS_REASON_TASK_ENDED;
        ENDIF
        ROS_pack_status state, code, in_error, in_motion, possible;

        IF progress_enabled ROS_pack_progress progress, newest;
        message_features := 0;
        set_alarm TRUE;
        FOR slot FROM 1 TO SLOTS DO
            IF is_served{slot} send_to_client slot;
        ENDFOR
        set_alarm FALSE;
        last_sent_stamp := stamp;
    ERROR
        ! A value that does not fit into the message keeps its old value.
        SkipWarn;
        TRYNEXT;
    ENDPROC

    ! Return TRUE if a trajectory would be accepted now and the supervisor is running.
    LOCAL FUNC bool is_possible()
        RETURN (NOT ROS_supervisor_missing) AND ROS_not_ready_2 = ROS_REASON_NONE;
    ENDFUNC

    ! Send all messages of one period in one call, because a socket call takes longer than everything
    ! else.
    LOCAL PROC send_to_client(num slot)
        VAR bool is_connected;

        IF has_feature(slot, ROS_FEATURE_PROGRESS) OR has_feature(slot, ROS_FEATURE_FEEDBACK) THEN
            IF features{slot} <> message_features build_message slot;
            is_connected := send_message(slot, message);
        ELSE
            is_connected := send_message(slot, state);
        ENDIF
        IF NOT is_connected drop_client slot;
    ENDPROC

    LOCAL PROC build_message(num slot)
        message_features := features{slot};
        ClearRawBytes message;
        message_bytes := 0;
        append_data state, ROS_LEN_JOINT_POSITION + ROS_LEN_STATUS + 8;
        IF has_feature(slot, ROS_FEATURE_PROGRESS) append_data progress, ROS_LEN_PROGRESS + 4;
        IF has_feature(slot, ROS_FEATURE_FEEDBACK) append_data feedback, ROS_LEN_JOINT_FEEDBACK + 4;
    ENDPROC

    LOCAL PROC append_data(VAR rawbytes data, num bytes)
        CopyRawBytes data, 1, message, message_bytes + 1 \NoOfBytes:=bytes;
        message_bytes := message_bytes + bytes;
    ENDPROC

    ! Pack JOINT_FEEDBACK. A client can request it only after at least one message was sent, so previous
    ! values exist.
    LOCAL PROC pack_feedback(jointtarget joints)
        VAR num seconds;

        seconds := stamp - last_sent_stamp;
        IF seconds <= 0 seconds := seconds + CLOCK_LIMIT;
        ROS_pack_velocities feedback, joints, last_sent_joints, seconds;
        ROS_pack_feedback feedback, state, stamp;
    ERROR
        RAISE;
    ENDPROC

    ! Return TRUE if a client has requested a feature.
    LOCAL FUNC bool is_enabled(num feature)
        FOR slot FROM 1 TO SLOTS DO
            IF has_feature(slot, feature) RETURN TRUE;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    LOCAL FUNC bool has_feature(num slot, num feature)
        RETURN (features{slot} DIV feature) MOD 2 = 1;
    ENDFUNC

    LOCAL FUNC bool send_message(num slot, VAR rawbytes data)
        VAR bool is_connected;

        send_count := ROS_next_count(send_count);
        sending_slot := slot;
        is_connected := ROS_send(client{slot}, data);
        sending_slot := 0;
        RETURN is_connected;
    ENDFUNC

    ! Start or stop the alarm around the sends of a period. SocketSend has no time-out argument.
    LOCAL PROC set_alarm(bool on)
        IDelete int_alarm;
        IF NOT on RETURN;
        CONNECT int_alarm WITH on_alarm;
        ITimer \Single, SEND_TIMEOUT, int_alarm;
    ENDPROC

    ! The same send is still in progress at the next alarm: its client does not read. Closing its socket
    ! ends the send.
    LOCAL TRAP on_alarm
        IF sending_slot > 0 AND send_count = suspect_send SocketClose client{sending_slot};
        suspect_send := send_count;
        set_alarm TRUE;
    ENDTRAP

    ! Return TRUE while a trajectory is active that neither is halted nor waits, while an axis moves,
    ! and once after any movement between two messages.
    LOCAL FUNC bool is_moving(jointtarget joints)
        VAR num started;
        VAR bool has_moved;

        started := ROS_started_trajectory_2;
        has_moved := started <> last_sent_started OR (NOT is_unmoved(joints));
        IF reports_motion(has_moved) has_moved := TRUE;
        IF ROS_is_active() AND (NOT is_held()) has_moved := TRUE;
        last_sent_started := started;
        last_sent_joints := joints;
        RETURN has_moved;
    ENDFUNC

    ! Return TRUE if the controller's signal reports motion and is plausible.
    LOCAL FUNC bool reports_motion(bool axis_moved)
        VAR num standing;

        standing := ROS_standing();
        IF standing = ROS_TRI_TRUE OR (axis_moved AND hold_seconds > 0) hold_seconds := HOLD_TIME;
        IF standing <> ROS_TRI_FALSE OR hold_seconds <= 0 RETURN FALSE;
        hold_seconds := hold_seconds - SEND_PERIOD;
        RETURN TRUE;
    ENDFUNC

    ! Return TRUE if the active trajectory stands: halted, paused or without a next point.
    LOCAL FUNC bool is_held()
        IF ROS_paused_trajectory_2 = ROS_active_trajectory_2 RETURN TRUE;
        RETURN ROS_halted_trajectory_2 = ROS_active_trajectory_2 OR ROS_starved_trajectory_2 = ROS_active_trajectory_2;
    ENDFUNC

    ! Return TRUE if no axis has moved since the last message by more than STANDSTILL_TOL.
    LOCAL FUNC bool is_unmoved(jointtarget joints)
        IF Abs(joints.robax.rax_1 - last_sent_joints.robax.rax_1) > STANDSTILL_TOL RETURN FALSE;
        IF Abs(joints.robax.rax_2 - last_sent_joints.robax.rax_2) > STANDSTILL_TOL RETURN FALSE;
        IF Abs(joints.robax.rax_3 - last_sent_joints.robax.rax_3) > STANDSTILL_TOL RETURN FALSE;
        IF Abs(joints.robax.rax_4 - last_sent_joints.robax.rax_4) > STANDSTILL_TOL RETURN FALSE;
        IF Abs(joints.robax.rax_5 - last_sent_joints.robax.rax_5) > STANDSTILL_TOL RETURN FALSE;
        IF Abs(joints.robax.rax_6 - last_sent_joints.robax.rax_6) > STANDSTILL_TOL RETURN FALSE;
        RETURN TRUE;
    ENDFUNC

    ! Read the clients' requests, send events, and look for new clients.
    LOCAL PROC serve_clients()
        ROS_start_clock clock_poll;
        set_alarm TRUE;
        FOR slot FROM 1 TO SLOTS DO
            IF is_served{slot} THEN
                IF NOT read_client(slot) drop_client slot;
            ENDIF
        ENDFOR
        IF events_enabled send_event;
        set_alarm FALSE;
        accept_due := NOT accept_due;
        IF accept_due AND clients > 0 accept_client ROS_NO_WAIT;
    ERROR
        SkipWarn;
        TRYNEXT;
    ENDPROC

    ! Read the requests of a client. Anything but HELLO closes the connection.
    LOCAL FUNC bool read_client(num slot)
        VAR rawbytes request;
        VAR num available;
        VAR num received;

        available := ROS_peek(client{slot});
        IF available < 0 RETURN FALSE;
        ! An incomplete message stays in the socket until the rest has arrived.
        IF available < ROS_LEN_HELLO + 4 RETURN TRUE;
        received := ROS_receive(client{slot}, request, ROS_PEEKED_TIMEOUT);
        IF NOT ROS_handle_hello(request, received, message, features{slot}) RETURN FALSE;
        update_subscriptions;
        RETURN send_message(slot, message);
    ENDFUNC

    ! Update what all clients together have requested. The event interrupt is connected only while a
    ! client wants events, because too many pending interrupts would stop this task.
    LOCAL PROC update_subscriptions()
        progress_enabled := is_enabled(ROS_FEATURE_PROGRESS);
        feedback_enabled := is_enabled(ROS_FEATURE_FEEDBACK);
        IF is_enabled(ROS_FEATURE_EVENTS) = events_enabled RETURN;
        events_enabled := NOT events_enabled;
        IDelete int_event;
        events_read := events_written;
        events_lost := 0;
        IF NOT events_enabled RETURN;
        CONNECT int_event WITH on_event;
        IError COMMON_ERR, TYPE_ALL, int_event;
    ENDPROC

    LOCAL TRAP on_event
        VAR trapdata trap_info;
        VAR errdomain domain;
        VAR num number;
        VAR errtype err_type;
        VAR string title;
        VAR string first_text;
        VAR string second_text;
        VAR num place;

        IF (events_written - events_read + ROS_WRAP) MOD ROS_WRAP >= MAX_EVENTS THEN
            events_lost := events_lost + 1;
            RETURN;
        ENDIF
        GetTrapData trap_info;
        ReadErrData trap_info, domain, number, err_type \Title:=title \Str1:=first_text \Str2:=second_text;
        place := events_written MOD MAX_EVENTS + 1;
        domains{place} := domain;
        numbers{place} := number;
        types{place} := err_type;
        titles{place} := title;
        upper_texts{place} := first_text;
        lower_texts{place} := second_text;
        events_written := ROS_next_count(events_written);
    ERROR
        SkipWarn;
        RETURN;
    ENDTRAP

    ! Send the oldest waiting event to the clients that want events, at most ten per second. The number
    ! of events that did not fit into the buffer is sent as an event of domain 0.
    LOCAL PROC send_event()
        VAR num place;

        IF events_read <> events_written THEN
            place := events_read MOD MAX_EVENTS + 1;
            ROS_pack_event message, domains{place}, numbers{place}, types{place};
            ROS_pack_texts message, titles{place}, upper_texts{place}, lower_texts{place};
            events_read := ROS_next_count(events_read);
        ELSEIF events_lost > 0 THEN
            ROS_pack_event message, 0, events_lost, ROS_EVENT_WARNING;
            ROS_pack_texts message, "Events that were not sent", "", "";
            events_lost := 0;
        ELSE
            RETURN;
        ENDIF
        FOR slot FROM 1 TO SLOTS DO
            IF has_feature(slot, ROS_FEATURE_EVENTS) THEN
                IF NOT send_message(slot, message) drop_client slot;
            ENDIF
        ENDFOR
    ERROR
        RAISE;
    ENDPROC

    ! Wait until the next message is due. The schedule is fixed, so the work of one period does not
    ! delay the next one.
    LOCAL PROC wait_for_period()
        VAR num now;
        VAR num due;

        ticks := ticks + 1;
        due := ticks / SEND_RATE + offset;
        now := ClkRead(schedule{active_clock});
        IF clients = 0 RETURN;
        IF now < due THEN
            WaitTime due - now;
        ELSEIF now > due + SEND_PERIOD THEN
            ! A send was delayed. Move the schedule instead of sending a burst.
            offset := offset + now - due;
            due := now;
        ENDIF
        IF due < CLOCK_LIMIT RETURN;
        ! Start the next clock between two readings of this one, so that no time is lost in the change.
        ClkReset schedule{3 - active_clock};
        now := ClkRead(schedule{active_clock} \HighRes);
        ClkStart schedule{3 - active_clock};
        now := (now + ClkRead(schedule{active_clock} \HighRes)) / 2;
        active_clock := 3 - active_clock;
        offset := due - now;
        overrun := overrun + now - CLOCK_LIMIT;
        IF overrun >= CLOCK_LIMIT overrun := overrun - CLOCK_LIMIT;
        ticks := 0;
    ENDPROC
ENDMODULE
