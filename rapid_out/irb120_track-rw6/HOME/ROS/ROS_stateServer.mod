MODULE ROS_stateServer
    ! The state server: JOINT and STATUS at a steady rate.
    !
    ! Robot "irb120_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! This task may hang in a send while its client does not read; nobody waits for it.

    CONST string ROS_BUILD_STATE := "34f2ecc7b0c4";

    LOCAL CONST num PORT := 11002;
    LOCAL CONST num PERIOD := 0.1;
    ! A num of this many seconds still tells a tenth of a millisecond from the next.
    LOCAL CONST num CLOCK_LIMIT := 1000;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! The other socket already holds the next client.
    LOCAL VAR bool taken_over := FALSE;
    LOCAL VAR rawbytes message;
    LOCAL VAR clock schedule;
    ! Messages are due at ticks x PERIOD + offset on this clock. Adding up periods in a 32-bit
    ! float would drift.
    LOCAL VAR num ticks := 0;
    LOCAL VAR num offset := 0;
    LOCAL VAR num idle := 0;
    LOCAL VAR bool progress := FALSE;
    LOCAL VAR bool linked := FALSE;
    LOCAL VAR ROS_progress newest;
    ! What was told last, so that a movement between two messages is told too.
    LOCAL VAR num told_started := 0;
    LOCAL VAR jointtarget told_joints;

    PROC main()
        ROS_start_task ROS_shown_state, ROS_BUILD_STATE \third:=ROS_BUILD_MESSAGES
            \fourth:=ROS_BUILD_SOCKET;
        ROS_listen server, PORT;
        WHILE TRUE DO
            serve client_1, client_2;
            serve client_2, client_1;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it is gone, or until a newer one has come on `newcomer`.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        IF NOT taken_over THEN
            WHILE NOT welcome(client, WAIT_MAX) DO
                ! A stranger, or the server socket broke and was opened again.
            ENDWHILE
        ENDIF
        taken_over := FALSE;
        progress := FALSE;
        linked := TRUE;
        idle := 0;
        ticks := 0;
        offset := 0;
        ClkReset schedule;
        ClkStart schedule;
        told_started := ROS_started;
        told_joints := CJointT();
        WHILE linked AND (NOT taken_over) DO
            linked := tell(client);
            IF linked linked := listened(client);
            idle := idle + PERIOD;
            IF linked AND idle >= 1 THEN
                idle := 0;
                ! The newest client is served: the one before may be a dead link.
                taken_over := welcome(newcomer, 0.001);
            ENDIF
            wait_for_turn;
        ENDWHILE
        SocketClose client;
    ENDPROC

    LOCAL FUNC bool welcome(VAR socketdev client, num seconds)
        TEST ROS_accept(server, client, seconds)
        CASE ROS_ACCEPT_CLIENT:
            RETURN TRUE;
        CASE ROS_ACCEPT_BROKEN:
            ROS_listen server, PORT;
            RETURN FALSE;
        DEFAULT:
            RETURN FALSE;
        ENDTEST
    ENDFUNC

    ! Send one JOINT, one STATUS and, if it was asked for, one PROGRESS.
    LOCAL FUNC bool tell(VAR socketdev client)
        VAR jointtarget joints;
        VAR num code := 0;
        VAR num in_error := ROS_TRI_FALSE;
        VAR num in_motion := ROS_TRI_FALSE;
        VAR num possible := ROS_TRI_FALSE;

        joints := CJointT();
        ROS_pack_joints message, joints;
        IF NOT ROS_send(client, message) RETURN FALSE;

        look;
        IF newest.state = ROS_TRAJ_REFUSED OR newest.state = ROS_TRAJ_FAILED
            in_error := ROS_TRI_TRUE;
        IF ROS_controller_error() = ROS_TRI_TRUE in_error := ROS_TRI_TRUE;
        IF moving(joints) in_motion := ROS_TRI_TRUE;
        IF ROS_not_ready = ROS_REASON_NONE possible := ROS_TRI_TRUE;
        IF in_error = ROS_TRI_TRUE code := newest.code;
        ROS_pack_status message, code, in_error, in_motion, possible;
        IF NOT ROS_send(client, message) RETURN FALSE;

        IF progress THEN
            ROS_pack_progress message, newest;
            RETURN ROS_send(client, message);
        ENDIF
        RETURN TRUE;
    ENDFUNC

    ! See what has become of the newest trajectory: look again if a newer one begins meanwhile,
    ! so that a number never comes with what belongs to another.
    LOCAL PROC look()
        VAR num trajectory := -1;

        WHILE trajectory <> ROS_trajectory DO
            trajectory := ROS_trajectory;
            look_at trajectory;
        ENDWHILE
    ENDPROC

    LOCAL PROC look_at(num trajectory)
        newest := [trajectory,ROS_TRAJ_RECEIVING,0,0,0,ROS_REASON_NONE,-1];
        ! It begins just now: all the rest is still of the one before.
        IF ROS_phase_of <> trajectory RETURN;
        newest.state := ROS_phase;
        newest.received := ROS_received;
        TEST newest.state
        CASE ROS_TRAJ_REFUSED, ROS_TRAJ_STOPPED:
            ! A refusal becomes a stop when STOP comes: the code says which it is.
            newest.code := ROS_refusal;
            IF newest.code = ROS_REASON_STOPPED THEN
                newest.state := ROS_TRAJ_STOPPED;
            ELSE
                newest.state := ROS_TRAJ_REFUSED;
                newest.index := ROS_refused_at;
            ENDIF
        CASE ROS_TRAJ_MOVING:
            look_at_motion trajectory;
        ENDTEST
    ENDPROC

    ! The state is read before the counts, and what was reached before what was planned: none
    ! is told that is ahead of what it follows from.
    LOCAL PROC look_at_motion(num trajectory)
        IF ROS_done = trajectory THEN
            newest.state := ROS_TRAJ_DONE;
        ELSEIF ROS_dead = trajectory THEN
            newest.code := ROS_dead_reason;
            newest.state := ended(newest.code);
        ELSEIF ROS_halted = trajectory THEN
            newest.code := ROS_halt_reason;
            newest.state := ended(newest.code);
        ENDIF
        IF ROS_started = trajectory THEN
            newest.reached := ROS_reached;
            newest.planned := ROS_planned;
        ENDIF
        IF newest.code <> ROS_REASON_NONE newest.index := newest.reached;
    ENDPROC

    ! State of a trajectory that ended early for this reason.
    LOCAL FUNC num ended(num code)
        IF code = ROS_REASON_STOPPED OR code = ROS_REASON_SUPERSEDED RETURN ROS_TRAJ_STOPPED;
        RETURN ROS_TRAJ_FAILED;
    ENDFUNC

    ! TRUE while a trajectory is under way that was not halted, while an axis turns, and once
    ! after any movement that fell between two messages.
    LOCAL FUNC bool moving(jointtarget joints)
        VAR num started;
        VAR bool moved;

        started := ROS_started;
        moved := started <> told_started OR ROS_standing() = ROS_TRI_FALSE OR (NOT near(joints));
        IF ROS_active() AND ROS_halted <> ROS_session moved := TRUE;
        told_started := started;
        told_joints := joints;
        RETURN moved;
    ENDFUNC

    ! TRUE if no axis has moved since the last message by more than a sensor's noise.
    LOCAL FUNC bool near(jointtarget joints)
        IF Abs(joints.robax.rax_1 - told_joints.robax.rax_1) > 0.05 RETURN FALSE;
        IF Abs(joints.robax.rax_2 - told_joints.robax.rax_2) > 0.05 RETURN FALSE;
        IF Abs(joints.robax.rax_3 - told_joints.robax.rax_3) > 0.05 RETURN FALSE;
        IF Abs(joints.robax.rax_4 - told_joints.robax.rax_4) > 0.05 RETURN FALSE;
        IF Abs(joints.robax.rax_5 - told_joints.robax.rax_5) > 0.05 RETURN FALSE;
        IF Abs(joints.robax.rax_6 - told_joints.robax.rax_6) > 0.05 RETURN FALSE;
        IF Abs(joints.extax.eax_a - told_joints.extax.eax_a) > 0.05 RETURN FALSE;
        IF Abs(joints.extax.eax_b - told_joints.extax.eax_b) > 0.05 RETURN FALSE;
        RETURN TRUE;
    ENDFUNC

    ! Take what the client says: HELLO, or nothing. Anything else breaks the link.
    LOCAL FUNC bool listened(VAR socketdev client)
        VAR rawbytes heard;
        VAR num waiting;
        VAR num received;
        VAR num length := 0;
        VAR num type := 0;
        VAR num comm := 0;
        VAR num version := 0;
        VAR num wanted := 0;

        waiting := ROS_peek(client);
        IF waiting = 0 RETURN TRUE;
        ! A part of a message is left where it is until the rest has come.
        IF waiting > 0 AND waiting < ROS_LEN_HELLO + 4 RETURN TRUE;
        IF waiting < 0 RETURN FALSE;
        received := ROS_receive(client, heard, 1);
        IF received <> ROS_LEN_HELLO + 4 RETURN FALSE;
        UnpackRawBytes heard, 1, length \IntX:=DINT;
        UnpackRawBytes heard, 5, type \IntX:=DINT;
        UnpackRawBytes heard, 9, comm \IntX:=DINT;
        IF length <> ROS_LEN_HELLO OR type <> ROS_MSG_HELLO RETURN FALSE;
        IF comm <> ROS_COMM_REQUEST RETURN FALSE;
        UnpackRawBytes heard, 17, version \IntX:=DINT;
        UnpackRawBytes heard, 33, wanted \IntX:=DINT;
        IF version < ROS_PROTOCOL THEN
            ROS_pack_hello_refused message;
        ELSE
            progress := (wanted MOD 2 = 1);
            ROS_pack_hello message;
        ENDIF
        RETURN ROS_send(client, message);
    ERROR
        ! Numbers that no client of ours would send.
        SkipWarn;
        RETURN FALSE;
    ENDFUNC

    ! Wait until the next message is due: by a schedule, so that the work of one round does not
    ! delay the next.
    LOCAL PROC wait_for_turn()
        VAR num now;
        VAR num due;

        ticks := ticks + 1;
        due := ticks * PERIOD + offset;
        now := ClkRead(schedule);
        IF now < due THEN
            WaitTime due - now;
        ELSEIF now > due + PERIOD THEN
            ! A send was held up: do not catch up by a burst.
            offset := offset + now - due;
            due := now;
        ENDIF
        IF due < CLOCK_LIMIT RETURN;
        now := ClkRead(schedule);
        ClkReset schedule;
        ClkStart schedule;
        offset := due - now;
        ticks := 0;
    ENDPROC
ENDMODULE
