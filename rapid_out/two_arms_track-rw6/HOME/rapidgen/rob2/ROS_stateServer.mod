MODULE ROS_stateServer
    ! The state server: JOINT and STATUS at a steady rate.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! Some clients at once: a program and those who watch it. All get what was measured at one
    ! moment. Nobody waits for this task. A client that does not read would hold up the others
    ! in a send, so a send that takes too long is broken off, and its client dropped.

    CONST string ROS_BUILD_STATE_SERVER := "88e807c4be29";

    LOCAL CONST num PORT := 11012;
    LOCAL CONST num PERIOD := 0.1;
    LOCAL CONST num RATE := 10;
    ! A num of this many seconds still tells a tenth of a millisecond from the next.
    LOCAL CONST num CLOCK_LIMIT := 1000;
    ! Sockets for clients: one more than are served, so that the newest has a place to come to.
    LOCAL CONST num SLOTS := 4;
    ! s between two looks at what clients say; each second look is for new clients, too.
    LOCAL CONST num LOOK_PERIOD := 0.1;
    ! s: a send is broken off when it has lasted from one alarm to the next.
    LOCAL CONST num PATIENCE := 0.1;
    ! deg or mm: an axis that has moved by less since the last message stands.
    LOCAL CONST num NOISE := 0.05;
    ! s: the controller's word that the robot moves counts for so long while no axis leaves its
    ! place. A signal that nothing drives any more would say so for ever.
    LOCAL CONST num BELIEF_MAX := 10;
    ! Events of the controller that wait to be told.
    LOCAL CONST num EVENTS := 16;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client{SLOTS};
    ! Of each slot: whether it serves a client, and what that has asked for (bits of
    ! ROS_FEATURE).
    LOCAL VAR bool served{SLOTS};
    LOCAL VAR num wants{SLOTS};
    LOCAL VAR num clients := 0;
    ! Slot of the client that came last.
    LOCAL VAR num latest := 1;
    LOCAL VAR bool progress_wanted := FALSE;
    LOCAL VAR bool feedback_wanted := FALSE;
    LOCAL VAR bool look_for_clients := FALSE;
    LOCAL VAR clock since_look;

    ! JOINT and STATUS; what may come behind them; and all of that for one client.
    LOCAL VAR rawbytes state;
    LOCAL VAR rawbytes progress;
    LOCAL VAR rawbytes feedback;
    LOCAL VAR rawbytes message;
    LOCAL VAR num message_wants := 0;
    LOCAL VAR num message_bytes := 0;

    ! Messages are due at ticks / RATE + offset on the clock that runs: adding up periods in a
    ! 32-bit float would drift. The other clock is the next one.
    LOCAL VAR clock schedule{2};
    LOCAL VAR num running := 1;
    LOCAL VAR num ticks := 0;
    LOCAL VAR num offset := 0;
    ! The time stamp of feedback counts CLOCK_LIMIT exactly: by what the clock had run over.
    LOCAL VAR num overrun := 0;
    LOCAL VAR num stamp := 0;
    LOCAL VAR num told_stamp := 0;

    LOCAL VAR ROS_progress newest;
    ! What was told last, so that a movement between two messages is told too.
    LOCAL VAR num told_started := 0;
    LOCAL VAR jointtarget told_joints;
    ! s that the controller's word is still believed; 0 until it has said that the robot stands.
    LOCAL VAR num belief := 0;

    ! A send under way: its slot (0: none) and its number; and the one that the alarm found.
    LOCAL VAR intnum alarm;
    LOCAL VAR num sending := 0;
    LOCAL VAR num sends := 0;
    LOCAL VAR num suspect := -1;

    ! Events between the trap, which puts them in, and main, which takes them out.
    LOCAL VAR intnum event;
    LOCAL VAR bool events_wanted := FALSE;
    LOCAL VAR num domains{EVENTS};
    LOCAL VAR num numbers{EVENTS};
    LOCAL VAR num types{EVENTS};
    LOCAL VAR string titles{EVENTS};
    LOCAL VAR string upper_texts{EVENTS};
    LOCAL VAR string lower_texts{EVENTS};
    LOCAL VAR num events_put := 0;
    LOCAL VAR num events_taken := 0;
    LOCAL VAR num events_lost := 0;

    PROC main()
        ROS_start_task ROS_shown_state_2,
            ROS_BUILD_LIMITS = ROS_BUILD_ID AND ROS_BUILD_MESSAGES = ROS_BUILD_ID AND
            ROS_BUILD_SOCKET = ROS_BUILD_ID AND ROS_BUILD_STATE_SERVER = ROS_BUILD_ID;
        ROS_begin_pulse 3;
        ROS_read_limits;
        ROS_form_state state;
        ROS_pack_topic progress, ROS_LEN_PROGRESS, ROS_MSG_PROGRESS;
        ROS_form_feedback feedback;
        ROS_listen server, PORT;
        WHILE TRUE DO
            IF clients = 0 wait_for_client;
            tell;
            ! In the round that is nearest.
            IF ClkRead(since_look) > LOOK_PERIOD - PERIOD / 2 look_after_clients;
            wait_for_turn;
        ENDWHILE
    ERROR
        SkipWarn;
        TRYNEXT;
    ENDPROC

    LOCAL PROC wait_for_client()
        WHILE clients = 0 DO
            IF ROS_standing() = ROS_TRI_TRUE belief := BELIEF_MAX;
            welcome ROS_WAIT;
        ENDWHILE
        ticks := 0;
        offset := 0;
        ROS_start_clock schedule{running};
        ROS_start_clock since_look;
        told_started := ROS_started_2;
        told_joints := CJointT();
    ENDPROC

    ! Take a new client, if there is one within `seconds`.
    LOCAL PROC welcome(num seconds)
        VAR num slot;

        slot := free_slot();
        IF NOT ROS_accept(server, PORT, client{slot}, seconds) RETURN;
        served{slot} := TRUE;
        clients := clients + 1;
        ! The newest is served, and those who came first are not disturbed.
        IF clients = SLOTS drop latest;
        latest := slot;
    ENDPROC

    LOCAL FUNC num free_slot()
        FOR slot FROM 1 TO SLOTS - 1 DO
            IF NOT served{slot} RETURN slot;
        ENDFOR
        RETURN SLOTS;
    ENDFUNC

    LOCAL PROC drop(num slot)
        SocketClose client{slot};
        served{slot} := FALSE;
        wants{slot} := 0;
        clients := clients - 1;
        note_wishes;
    ENDPROC

    ! Send each client one JOINT, one STATUS and what it has asked for.
    LOCAL PROC tell()
        VAR jointtarget joints;
        VAR num code := 0;
        VAR num in_error := ROS_TRI_FALSE;
        VAR num in_motion := ROS_TRI_FALSE;
        VAR num possible := ROS_TRI_FALSE;

        joints := CJointT();
        stamp := ClkRead(schedule{running} \HighRes) + overrun;
        IF stamp >= CLOCK_LIMIT stamp := stamp - CLOCK_LIMIT;
        ROS_pack_joints state, joints;

        ROS_look newest;
        IF newest.state = ROS_TRAJ_REFUSED OR newest.state = ROS_TRAJ_FAILED in_error := ROS_TRI_TRUE;
        IF ROS_controller_error() = ROS_TRI_TRUE in_error := ROS_TRI_TRUE;
        IF feedback_wanted measure joints;
        IF moving(joints) in_motion := ROS_TRI_TRUE;
        IF is_possible() possible := ROS_TRI_TRUE;
        IF in_error = ROS_TRI_TRUE code := newest.code;
        IF ROS_unsupervised OR ROS_not_ready_2 = ROS_REASON_TASK_ENDED THEN
            in_error := ROS_TRI_TRUE;
            code := ROS_REASON_TASK_ENDED;
        ENDIF
        ROS_pack_status state, code, in_error, in_motion, possible;

        IF progress_wanted ROS_pack_progress progress, newest;
        message_wants := 0;
        set_alarm TRUE;
        FOR slot FROM 1 TO SLOTS DO
            IF served{slot} tell_client slot;
        ENDFOR
        set_alarm FALSE;
        told_stamp := stamp;
    ERROR
        ! A value that no message can hold stays what it was in the message before.
        SkipWarn;
        TRYNEXT;
    ENDPROC

    ! TRUE if a trajectory would be taken now: so says a supervisor whose pulse is seen.
    LOCAL FUNC bool is_possible()
        RETURN (NOT ROS_unsupervised) AND ROS_not_ready_2 = ROS_REASON_NONE;
    ENDFUNC

    ! All of one period leaves in one send: a socket call costs more than all the rest.
    LOCAL PROC tell_client(num slot)
        VAR bool linked;

        IF has(slot, ROS_FEATURE_PROGRESS) OR has(slot, ROS_FEATURE_FEEDBACK) THEN
            IF wants{slot} <> message_wants compose slot;
            linked := sent(slot, message);
        ELSE
            linked := sent(slot, state);
        ENDIF
        IF NOT linked drop slot;
    ENDPROC

    LOCAL PROC compose(num slot)
        message_wants := wants{slot};
        ClearRawBytes message;
        message_bytes := 0;
        append state, ROS_LEN_JOINT_POSITION + ROS_LEN_STATUS + 8;
        IF has(slot, ROS_FEATURE_PROGRESS) append progress, ROS_LEN_PROGRESS + 4;
        IF has(slot, ROS_FEATURE_FEEDBACK) append feedback, ROS_LEN_JOINT_FEEDBACK + 4;
    ENDPROC

    LOCAL PROC append(VAR rawbytes data, num bytes)
        CopyRawBytes data, 1, message, message_bytes + 1 \NoOfBytes:=bytes;
        message_bytes := message_bytes + bytes;
    ENDPROC

    ! JOINT_FEEDBACK: nobody can ask for it before there is something to compare with.
    LOCAL PROC measure(jointtarget joints)
        VAR num seconds;

        seconds := stamp - told_stamp;
        IF seconds <= 0 seconds := seconds + CLOCK_LIMIT;
        ROS_pack_velocities feedback, joints, told_joints, seconds;
        ROS_pack_feedback feedback, state, stamp;
    ERROR
        RAISE;
    ENDPROC

    ! TRUE if a client has asked for a feature.
    LOCAL FUNC bool wanted(num feature)
        FOR slot FROM 1 TO SLOTS DO
            IF has(slot, feature) RETURN TRUE;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    LOCAL FUNC bool has(num slot, num feature)
        RETURN (wants{slot} DIV feature) MOD 2 = 1;
    ENDFUNC

    LOCAL FUNC bool sent(num slot, VAR rawbytes data)
        VAR bool linked;

        sends := ROS_next(sends);
        sending := slot;
        linked := ROS_send(client{slot}, data);
        sending := 0;
        RETURN linked;
    ENDFUNC

    ! Around the sends of a period. SocketSend has no time-out of its own to be set.
    LOCAL PROC set_alarm(bool on)
        IDelete alarm;
        IF NOT on RETURN;
        CONNECT alarm WITH on_alarm;
        ITimer \Single, PATIENCE, alarm;
    ENDPROC

    ! Here again in the same send: its client does not read. Without its socket the send ends.
    LOCAL TRAP on_alarm
        IF sending > 0 AND sends = suspect SocketClose client{sending};
        suspect := sends;
        set_alarm TRUE;
    ENDTRAP

    ! TRUE while a trajectory is under way that was not halted and does not wait, while an axis
    ! turns, and once after any movement that fell between two messages.
    LOCAL FUNC bool moving(jointtarget joints)
        VAR num started;
        VAR bool moved;

        started := ROS_started_2;
        moved := started <> told_started OR (NOT near(joints));
        IF turning(moved) moved := TRUE;
        IF ROS_active() AND (NOT held()) moved := TRUE;
        told_started := started;
        told_joints := joints;
        RETURN moved;
    ENDFUNC

    ! TRUE if the controller says that the robot moves, and is to be believed.
    LOCAL FUNC bool turning(bool seen)
        VAR num standing;

        standing := ROS_standing();
        IF standing = ROS_TRI_TRUE OR (seen AND belief > 0) belief := BELIEF_MAX;
        IF standing <> ROS_TRI_FALSE OR belief <= 0 RETURN FALSE;
        belief := belief - PERIOD;
        RETURN TRUE;
    ENDFUNC

    ! TRUE if the trajectory under way stands: halted, paused or without a next point.
    LOCAL FUNC bool held()
        IF ROS_paused_2 = ROS_session_2 RETURN TRUE;
        RETURN ROS_halted_2 = ROS_session_2 OR ROS_starved_2 = ROS_session_2;
    ENDFUNC

    ! TRUE if no axis has moved since the last message by more than a sensor's noise.
    LOCAL FUNC bool near(jointtarget joints)
        IF Abs(joints.robax.rax_1 - told_joints.robax.rax_1) > NOISE RETURN FALSE;
        IF Abs(joints.robax.rax_2 - told_joints.robax.rax_2) > NOISE RETURN FALSE;
        IF Abs(joints.robax.rax_3 - told_joints.robax.rax_3) > NOISE RETURN FALSE;
        IF Abs(joints.robax.rax_4 - told_joints.robax.rax_4) > NOISE RETURN FALSE;
        IF Abs(joints.robax.rax_5 - told_joints.robax.rax_5) > NOISE RETURN FALSE;
        IF Abs(joints.robax.rax_6 - told_joints.robax.rax_6) > NOISE RETURN FALSE;
        RETURN TRUE;
    ENDFUNC

    ! Hear what clients say, tell them of events, and see whether new ones have come.
    LOCAL PROC look_after_clients()
        ROS_start_clock since_look;
        set_alarm TRUE;
        FOR slot FROM 1 TO SLOTS DO
            IF served{slot} THEN
                IF NOT listened(slot) drop slot;
            ENDIF
        ENDFOR
        IF events_wanted tell_event;
        set_alarm FALSE;
        look_for_clients := NOT look_for_clients;
        IF look_for_clients AND clients > 0 welcome 0.001;
    ERROR
        SkipWarn;
        TRYNEXT;
    ENDPROC

    ! Take what a client says: HELLO, or nothing. Anything else breaks the link.
    LOCAL FUNC bool listened(num slot)
        VAR rawbytes heard;
        VAR num waiting;
        VAR num received;

        waiting := ROS_peek(client{slot});
        IF waiting < 0 RETURN FALSE;
        ! A part of a message is left where it is until the rest has come.
        IF waiting < ROS_LEN_HELLO + 4 RETURN TRUE;
        received := ROS_receive(client{slot}, heard, 1);
        IF NOT ROS_take_hello(heard, received, message, wants{slot}) RETURN FALSE;
        note_wishes;
        RETURN sent(slot, message);
    ENDFUNC

    ! See what all clients together want. Interrupts for events are ordered only while someone
    ! does: a controller that has many to tell stops a task that does not take them.
    LOCAL PROC note_wishes()
        progress_wanted := wanted(ROS_FEATURE_PROGRESS);
        feedback_wanted := wanted(ROS_FEATURE_FEEDBACK);
        IF wanted(ROS_FEATURE_EVENTS) = events_wanted RETURN;
        events_wanted := NOT events_wanted;
        IDelete event;
        events_taken := events_put;
        events_lost := 0;
        IF NOT events_wanted RETURN;
        CONNECT event WITH on_event;
        IError COMMON_ERR, TYPE_ALL, event;
    ENDPROC

    LOCAL TRAP on_event
        VAR trapdata found;
        VAR errdomain domain;
        VAR num number;
        VAR errtype kind;
        VAR string title;
        VAR string first;
        VAR string second;
        VAR num place;

        IF (events_put - events_taken + ROS_WRAP) MOD ROS_WRAP >= EVENTS THEN
            events_lost := events_lost + 1;
            RETURN;
        ENDIF
        GetTrapData found;
        ReadErrData found, domain, number, kind \Title:=title \Str1:=first \Str2:=second;
        place := events_put MOD EVENTS + 1;
        domains{place} := domain;
        numbers{place} := number;
        types{place} := kind;
        titles{place} := title;
        upper_texts{place} := first;
        lower_texts{place} := second;
        events_put := ROS_next(events_put);
    ERROR
        SkipWarn;
        RETURN;
    ENDTRAP

    ! Tell those who want it the oldest event that waits: ten a second at most. Those that did
    ! not fit are told as a number of the domain 0.
    LOCAL PROC tell_event()
        VAR num place;

        IF events_taken <> events_put THEN
            place := events_taken MOD EVENTS + 1;
            ROS_pack_event message, domains{place}, numbers{place}, types{place};
            ROS_pack_texts message, titles{place}, upper_texts{place}, lower_texts{place};
            events_taken := ROS_next(events_taken);
        ELSEIF events_lost > 0 THEN
            ROS_pack_event message, 0, events_lost, ROS_EVENT_WARNING;
            ROS_pack_texts message, "Events that were not told", "", "";
            events_lost := 0;
        ELSE
            RETURN;
        ENDIF
        FOR slot FROM 1 TO SLOTS DO
            IF has(slot, ROS_FEATURE_EVENTS) THEN
                IF NOT sent(slot, message) drop slot;
            ENDIF
        ENDFOR
    ERROR
        RAISE;
    ENDPROC

    ! Wait until the next message is due: by a schedule, so that the work of one round does not
    ! delay the next.
    LOCAL PROC wait_for_turn()
        VAR num now;
        VAR num due;

        ticks := ticks + 1;
        due := ticks / RATE + offset;
        now := ClkRead(schedule{running});
        IF clients = 0 RETURN;
        IF now < due THEN
            WaitTime due - now;
        ELSEIF now > due + PERIOD THEN
            ! A send was held up: do not catch up by a burst.
            offset := offset + now - due;
            due := now;
        ENDIF
        IF due < CLOCK_LIMIT RETURN;
        ! The next clock begins between two looks at this one: nothing is lost from one to the other.
        ClkReset schedule{3 - running};
        now := ClkRead(schedule{running} \HighRes);
        ClkStart schedule{3 - running};
        now := (now + ClkRead(schedule{running} \HighRes)) / 2;
        running := 3 - running;
        offset := due - now;
        overrun := overrun + now - CLOCK_LIMIT;
        IF overrun >= CLOCK_LIMIT overrun := overrun - CLOCK_LIMIT;
        ticks := 0;
    ENDPROC
ENDMODULE
