MODULE ROS_motionServer
    ! The motion server: the port for trajectories and STOP.
    !
    ! Robot "two_arms_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! A trajectory is sent as a whole, as points -1, 1, 2, ..., -3, or in batches (ROS_stream). The client
    ! sends STOP behind its points on the same connection. This task therefore never waits for free
    ! places in the ring buffer: it reads, and feeds the ring buffer in between.
    !
    ! Each point is checked when it arrives. A trajectory that is sent as a whole starts only after -3 has
    ! arrived and all points were accepted. Its points then go through the ring buffer to the motion task.

    ! Counts of stops and starts of the program, and of requests of the control server.
    RECORD ROS_stop_counts
        num program;
        num control;
        ! The same without stops for a lost client.
        num commands;
    ENDRECORD

    CONST string ROS_BUILD_MOTION_SERVER := "5273285319d5";

    ! ---- Connections ----

    LOCAL CONST num PORT := 11000;
    ! Time between two checks for bytes while the ring buffer is being fed, s. It is short compared with
    ! the duration of a point.
    LOCAL CONST num POLL_PERIOD := 0.008;
    ! Time without bytes after which a newer client is served, s, unless a trajectory is active. It is
    ! short, because the newer client may be the same one after a broken connection.
    LOCAL CONST num TAKEOVER_DELAY := 1;
    ! Time between two checks for newer clients, s. Each check takes about 1 ms.
    LOCAL CONST num ACCEPT_PERIOD := 0.1;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! TRUE if the other socket already holds the next client to serve; TRUE while the present client is
    ! connected.
    LOCAL VAR bool is_taken_over := FALSE;
    LOCAL VAR bool is_connected := FALSE;
    ! TRUE while the other socket holds a newer client that waits, and the bytes it has sent so far.
    LOCAL VAR bool has_newcomer := FALSE;
    LOCAL VAR rawbytes newcomer_data;
    LOCAL VAR num newcomer_bytes := 0;
    LOCAL VAR clock clock_accept;
    ! Stops that occurred before the newer client sent anything, and before any client connected that
    ! was not accepted yet.
    LOCAL VAR ROS_stop_counts stops_before_newcomer;
    LOCAL VAR ROS_stop_counts stops_before_others;
    LOCAL VAR rawbytes answer;
    ! Present message: its comm_type and reply code, whether it is a request, and the number of its
    ! point.
    LOCAL VAR num comm_type := 0;
    LOCAL VAR num reply_code := 0;
    LOCAL VAR bool is_request := FALSE;
    LOCAL VAR num message_sequence := 0;

    ! ---- Checks, start and refusal of the newest trajectory ----

    ! Longest duration of a point, s.
    CONST num ROS_MAX_DURATION := 3600;
    ! Shortest duration that the path planner follows through a corner, s (`min_segment`).
    CONST num ROS_MIN_SEGMENT := 0.1;
    ! Highest speed of each joint in a segment, deg/s or mm/s.
    CONST num ROS_MAX_SPEED{8} := [250.25,250.25,250.25,320.32,320.32,420.42,1001,180.18];

    ! A trajectory waits for a halt in progress: number of checks, and time between two of them, s. The
    ! robot stands after 3 s.
    LOCAL CONST num HALT_CHECKS := 30;
    LOCAL CONST num HALT_PERIOD := 0.1;
    ! Shortest time between two warnings about refusals, s. A client that repeats an error must not fill
    ! the event log.
    LOCAL CONST num REPORT_PERIOD := 1;
    ! Fraction of each axis' highest speed that is used to approach the first point.
    LOCAL CONST num APPROACH_FACTOR := 0.1;
    ! The robot stands at a point if no axis is farther away than this, deg or mm.
    LOCAL CONST num AT_TARGET_TOL := 0.01;
    ! A value that exceeds a limit by no more than this was rounded on its way and is replaced by the
    ! limit, deg or mm.
    LOCAL CONST num ROUNDING_TOL := 0.0005;
    ! Largest distance of each joint from the first point when the trajectory starts, deg or mm.
    LOCAL CONST num START_TOL{8} := [0.5,0.5,0.5,0.5,0.5,0.5,5,0.5];
    ! These data are copies of this task. The motion task has its own.
    TASK PERS tooldata torch := [TRUE,[[0,0,120],[1,0,0,0]],[1.2,[0,0,60],[1,0,0,0],0,0,0]];

    ! The point that is being checked, its duration (s), and the target of the previous point.
    VAR ROS_point ROS_new_point;
    VAR num ROS_duration := 0;
    VAR jointtarget ROS_previous;
    ! TRUE while this point is the first one.
    VAR bool ROS_is_first := TRUE;
    ! Number of accepted points of the trajectory, and the code (reason + 100 * joint) of the first
    ! fault of this point.
    VAR num ROS_point_count := 0;
    VAR num ROS_point_fault := 0;
    ! Number of points of a trajectory that was sent as a whole, and number of those already in the ring
    ! buffer.
    VAR num ROS_feed_total := 0;
    VAR num ROS_feed_count := 0;

    ! Stops that occurred before everything that is being read now was received.
    VAR ROS_stop_counts ROS_stops_before;
    ! Stops that occurred before the first point of the trajectory was received.
    LOCAL VAR ROS_stop_counts stops_at_start;
    ! TRUE while the motion server processes what a client sent before it replaced another one.
    VAR bool ROS_is_replacing := FALSE;
    ! TRUE if the trajectory replaces the one of another client. The end of that client is a stop, but not
    ! one of this trajectory.
    LOCAL VAR bool is_replacement := FALSE;
    ! At most one warning in REPORT_PERIOD is written. The others are counted.
    LOCAL VAR clock clock_report;
    LOCAL VAR num unreported := 0;
    LOCAL VAR bool clock_running := FALSE;

    ! ---- Trajectories that are sent as a whole ----

    ! TRUE while a trajectory is being received that was not refused.
    VAR bool ROS_receiving := FALSE;

    LOCAL VAR ROS_point points{ROS_CAPACITY};
    ! TRUE while the remaining points of a refused or stopped trajectory are skipped.
    LOCAL VAR bool skipping := FALSE;

    ! ---- Connections ----

    PROC main()
        ROS_start_task ROS_task_build_motion_server_1,
            ROS_BUILD_SERVER = ROS_BUILD_ID AND ROS_BUILD_PROGRAMS = ROS_BUILD_ID AND
            ROS_BUILD_STREAM = ROS_BUILD_ID AND ROS_BUILD_MOTION_SERVER = ROS_BUILD_ID;
        ROS_start_alive_count ROS_ROLE_MOTION_SERVER;
        ROS_read_limits \log;
        ! Initialise the counters to the values of those that answer them.
        ROS_head_1 := ROS_tail_1;
        ROS_closed_trajectory_1 := -1;
        ROS_phase_1 := ROS_TRAJ_NONE;
        ROS_phase_trajectory_1 := ROS_trajectory_1;
        ROS_end_trajectory ROS_REASON_CLIENT_LOST;
        ROS_listen server, PORT;
        stops_before_others := ROS_current_stops();
        WHILE TRUE DO
            serve client_1, client_2;
            drop_client client_1;
            serve client_2, client_1;
            drop_client client_2;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it disconnects or a newer client on `newcomer` takes over.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received;
        VAR num silence := 0;
        VAR bool was_active;

        IF NOT is_taken_over THEN
            WHILE NOT accept_client(client, ROS_WAIT_TIMEOUT) DO
                ! No client came, or one that is not allowed, or the server socket was opened again.
                ROS_publish_stops_seen stops_before_others;
            ENDWHILE
        ENDIF
        is_taken_over := FALSE;
        ROS_is_replacing := FALSE;
        is_connected := TRUE;
        ROS_partial_bytes := 0;
        ROS_start_clock clock_accept;
        ROS_stops_before := stops_before_newcomer;
        ROS_publish_stops_seen ROS_stops_before;
        ! Process what it sent while another client was served.
        received := newcomer_bytes;
        newcomer_bytes := 0;
        IF received > 0 THEN
            CopyRawBytes newcomer_data, 1, ROS_chunk, 1 \NoOfBytes:=received;
            ROS_is_replacing := TRUE;
            handle_chunk client, received;
            ROS_is_replacing := FALSE;
        ENDIF
        WHILE is_connected AND (NOT is_taken_over) DO
            was_active := ROS_is_active();
            update_stops client, newcomer;
            IF ROS_feed_count < ROS_feed_total THEN
                ROS_feed_ring;
                received := poll_client(client);
                silence := silence + POLL_PERIOD;
            ELSE
                received := ROS_receive(client, ROS_chunk, ROS_WAIT_TIMEOUT);
                silence := silence + ROS_WAIT_TIMEOUT;
            ENDIF
            ! The silence is measured from the end of an active trajectory.
            IF received <> 0 OR (was_active AND (NOT ROS_is_active())) silence := 0;
            IF received > 0 THEN
                handle_chunk client, received;
            ELSEIF received < 0 THEN
                is_connected := FALSE;
            ENDIF
            IF is_connected AND ROS_elapsed_seconds(clock_accept) >= ACCEPT_PERIOD check_newcomer newcomer, silence;
        ENDWHILE
    ERROR
        ! No data that a client sends may end this task.
        ErrWrite \W, "ROS: a client was dropped", "Error " + ValToStr(ERRNO) + " while serving it.";
        RETURN;
    ENDPROC

    ! Return TRUE if a client has connected on `client` within `seconds`.
    LOCAL FUNC bool accept_client(VAR socketdev client, num seconds)
        VAR ROS_stop_counts stops;

        stops := ROS_current_stops();
        ! After a stop, check without waiting that no client is there: STOP's reply depends on it.
        IF stops <> stops_before_others seconds := ROS_NO_WAIT;
        IF ROS_accept(server, PORT, client, seconds) THEN
            stops_before_newcomer := stops_before_others;
            RETURN TRUE;
        ENDIF
        ! A client that connects from now on has sent nothing before these stops.
        IF ROS_no_client stops_before_others := stops;
        RETURN FALSE;
    ENDFUNC

    ! What was received before a stop must not move the robot. Bytes are known to be newer than a stop
    ! if the socket was empty after it. The stops are published as seen when this is known for every
    ! client.
    LOCAL PROC update_stops(VAR socketdev client, VAR socketdev newcomer)
        VAR ROS_stop_counts stops;

        stops := ROS_current_stops();
        IF stops = ROS_stops_before OR ROS_partial_bytes > 0 RETURN;
        IF ROS_peek(client) = 0 ROS_stops_before := stops;
        IF ROS_stops_before <> stops RETURN;
        IF NOT has_newcomer has_newcomer := accept_client(newcomer, ROS_NO_WAIT);
        ROS_publish_stops_seen stops;
    ENDPROC

    ! Serve a newer client after the present one has been silent for a while: it may be the same client,
    ! whose old connection is broken without notice. During a trajectory the silence of its client means
    ! nothing, and a new connection is no reason to stop the robot.
    LOCAL PROC check_newcomer(VAR socketdev newcomer, num silence)
        VAR num reason;
        VAR ROS_stop_counts stops;

        ROS_start_clock clock_accept;
        IF NOT has_newcomer has_newcomer := accept_client(newcomer, ROS_NO_WAIT);
        IF NOT has_newcomer RETURN;
        stops := ROS_current_stops();
        IF newcomer_bytes = 0 THEN
            IF ROS_peek(newcomer) = 0 stops_before_newcomer := stops;
        ENDIF
        IF NOT ROS_is_active() THEN
            is_taken_over := (silence >= TAKEOVER_DELAY);
            RETURN;
        ENDIF
        reason := newcomer_request(newcomer);
        IF reason = ROS_REASON_FRAMING THEN
            SocketClose newcomer;
            has_newcomer := FALSE;
            newcomer_bytes := 0;
        ELSEIF reason <> ROS_REASON_NONE THEN
            ROS_end_trajectory reason;
            is_taken_over := TRUE;
        ENDIF
    ENDPROC

    ! Check what the waiting client requests. It may stop the active trajectory or start another one;
    ! all other messages wait. Return ROS_REASON_STOPPED or ROS_REASON_SUPERSEDED for the active
    ! trajectory, ROS_REASON_FRAMING if the client must be disconnected, or 0 if no such message has
    ! arrived yet.
    LOCAL FUNC num newcomer_request(VAR socketdev newcomer)
        VAR rawbytes received_data;
        VAR num bytes;
        VAR num at := 1;
        VAR num length;
        VAR num msg_type;
        VAR num point_number;

        bytes := ROS_peek(newcomer);
        IF bytes > 0 bytes := ROS_receive(newcomer, received_data, ROS_PEEKED_TIMEOUT);
        IF bytes = 0 RETURN ROS_REASON_NONE;
        IF bytes < 0 RETURN ROS_REASON_FRAMING;
        CopyRawBytes received_data, 1, newcomer_data, newcomer_bytes + 1 \NoOfBytes:=bytes;
        newcomer_bytes := newcomer_bytes + bytes;
        WHILE at + ROS_HEADER_BYTES + 7 <= newcomer_bytes DO
            UnpackRawBytes newcomer_data, at, length \IntX:=DINT;
            UnpackRawBytes newcomer_data, at + 4, msg_type \IntX:=DINT;
            IF NOT (ROS_HEADER_BYTES <= length AND length <= ROS_MAX_LENGTH) RETURN ROS_REASON_FRAMING;
            IF at + length + 3 > newcomer_bytes RETURN ROS_REASON_NONE;
            IF msg_type = ROS_MSG_POINTS OR msg_type = ROS_MSG_PROGRAM RETURN ROS_REASON_SUPERSEDED;
            IF msg_type = ROS_MSG_JOINT_TRAJ_PT THEN
                UnpackRawBytes newcomer_data, at + 16, point_number \IntX:=DINT;
                IF point_number = ROS_SEQ_STOP RETURN ROS_REASON_STOPPED;
                RETURN ROS_REASON_SUPERSEDED;
            ENDIF
            at := at + length + 4;
        ENDWHILE
        RETURN ROS_REASON_NONE;
    ERROR
        SkipWarn;
        RETURN ROS_REASON_FRAMING;
    ENDFUNC

    ! Disconnect the client. The robot does not continue for a lost client, and a part of a trajectory
    ! is discarded. A waiting client is served next. If it has taken over, it has already ended the
    ! active trajectory with its own reason.
    LOCAL PROC drop_client(VAR socketdev client)
        SocketClose client;
        ROS_drop_download;
        ROS_drop_stream;
        IF NOT (is_taken_over AND ROS_is_active()) ROS_end_trajectory ROS_REASON_CLIENT_LOST;
        is_taken_over := has_newcomer;
        has_newcomer := FALSE;
        ROS_wait_halted;
    ENDPROC

    ! Check for bytes without waiting for them, because the ring buffer is being fed.
    LOCAL FUNC num poll_client(VAR socketdev client)
        VAR num available;

        available := ROS_peek(client);
        IF available > 0 RETURN ROS_receive(client, ROS_chunk, ROS_PEEKED_TIMEOUT);
        IF available = 0 WaitTime POLL_PERIOD;
        RETURN available;
    ENDFUNC

    LOCAL PROC handle_chunk(VAR socketdev client, num received)
        ROS_start_chunk received;
        WHILE is_connected DO
            TEST ROS_next_frame()
            CASE ROS_FRAME_IN_CHUNK:
                handle_message client, ROS_chunk, ROS_frame_at;
            CASE ROS_FRAME_IN_PARTIAL:
                handle_message client, ROS_partial, 1;
            CASE ROS_FRAME_BROKEN:
                reject_framing;
            DEFAULT:
                RETURN;
            ENDTEST
        ENDWHILE
    ERROR
        RAISE;
    ENDPROC

    ! Handle the message that begins at byte `at` of `data`.
    LOCAL PROC handle_message(VAR socketdev client, VAR rawbytes data, num at)
        UnpackRawBytes data, at + 8, comm_type \IntX:=DINT;
        UnpackRawBytes data, at + 12, reply_code \IntX:=DINT;
        IF ROS_frame_type = ROS_MSG_JOINT_TRAJ_PT AND ROS_frame_length = ROS_LEN_JOINT_TRAJ_PT THEN
            UnpackRawBytes data, at + 16, message_sequence \IntX:=DINT;
            IF ROS_receiving AND message_sequence = ROS_point_count AND comm_type = ROS_COMM_TOPIC
                AND reply_code = ROS_REPLY_NONE THEN
                ! This is the most frequent case, so it is tested first.
                ROS_add_point data, at, message_sequence;
            ELSEIF NOT is_valid_comm() THEN
                reject_framing;
            ELSEIF message_sequence = ROS_SEQ_STOP THEN
                handle_stop client;
            ELSE
                ROS_handle_point data, at, message_sequence;
                IF is_request reply_point client;
            ENDIF
        ELSEIF ROS_frame_type = ROS_MSG_POINTS OR ROS_frame_type = ROS_MSG_PROGRAM THEN
            IF NOT is_valid_comm() THEN
                reject_framing;
                RETURN;
            ENDIF
            ROS_handle_batch data, at;
            IF is_request reply_batch client;
        ELSE
            handle_other client;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! Return TRUE for a topic or a request without a reply code. Anything else breaks the framing.
    LOCAL FUNC bool is_valid_comm()
        is_request := (comm_type = ROS_COMM_REQUEST);
        RETURN reply_code = ROS_REPLY_NONE AND (is_request OR comm_type = ROS_COMM_TOPIC);
    ENDFUNC

    ! The beginning of the next message is unknown, so nothing that follows can be trusted.
    LOCAL PROC reject_framing()
        IF ROS_receiving THEN
            ROS_refuse_download ROS_REASON_FRAMING, ROS_point_count, FALSE;
        ELSE
            ROS_report_refusal ROS_REASON_FRAMING, -1;
        ENDIF
        is_connected := FALSE;
    ENDPROC

    ! Handle a message without points.
    LOCAL PROC handle_other(VAR socketdev client)
        IF ROS_frame_type = ROS_MSG_JOINT_TRAJ_PT THEN
            ! A point of another size means that the framing is wrong.
            reject_framing;
        ELSEIF ROS_frame_type = ROS_MSG_PING THEN
            IF comm_type = ROS_COMM_REQUEST send_reply client, ROS_frame_type, ROS_REPLY_SUCCESS;
        ELSE
            ROS_report_refusal ROS_REASON_UNKNOWN_MESSAGE, -1;
            IF comm_type = ROS_COMM_REQUEST send_reply client, ROS_frame_type, ROS_REPLY_FAILURE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC send_reply(VAR socketdev client, num msg_type, num code)
        ROS_pack_reply answer, msg_type, code;
        is_connected := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    ! Reply to a point that is a request with the present state of the trajectory.
    LOCAL PROC reply_point(VAR socketdev client)
        IF ROS_phase_1 = ROS_TRAJ_REFUSED THEN
            ROS_pack_refused answer, ROS_refusal_code_1, ROS_refused_point_1;
        ELSEIF ROS_phase_1 = ROS_TRAJ_MOVING AND message_sequence = ROS_SEQ_END THEN
            ROS_pack_accepted answer, ROS_trajectory_1;
        ELSE
            ROS_pack_reply answer, ROS_MSG_JOINT_TRAJ_PT, ROS_REPLY_SUCCESS;
        ENDIF
        is_connected := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC reply_batch(VAR socketdev client)
        ROS_pack_batch_reply answer;
        is_connected := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    ! Handle STOP. The reply is sent when the robot was ordered to stop, not when it stands. Points of
    ! this trajectory that arrive later count as points without a beginning.
    LOCAL PROC handle_stop(VAR socketdev client)
        VAR num code := ROS_REPLY_SUCCESS;

        ROS_discard_download;
        ROS_discard_trajectory;
        ROS_end_trajectory ROS_REASON_STOPPED;
        IF ROS_run_state_1 = ROS_RUN_OUTSIDE THEN
            ! The supervisor reports that the moves of the program itself continue.
            ROS_stop_reason_1 := ROS_REASON_STOPPED;
            ROS_stop_asked_1 := ROS_next_count(ROS_stop_asked_1);
        ENDIF
        ROS_wait_halted;
        IF NOT ROS_wait_answered(ROS_REPLY_TIMEOUT - ROS_STOP_TIMEOUT) code := ROS_REPLY_FAILURE;
        IF is_request send_reply client, ROS_MSG_JOINT_TRAJ_PT, code;
    ERROR
        RAISE;
    ENDPROC

    ! ---- Checks, start and refusal of the newest trajectory ----

    ! A new trajectory ends the active one. The new one must begin where the robot then stands.
    PROC ROS_begin_trajectory()
        ROS_end_trajectory ROS_REASON_SUPERSEDED;
        ROS_new_trajectory;
        ! Tasks with modules of different builds may interpret a trajectory differently.
        IF ROS_get_build_fault() = ROS_REASON_BUILD_MISMATCH ROS_refuse ROS_REASON_BUILD_MISMATCH, -1;
    ENDPROC

    ! Return the present counts of stops.
    FUNC ROS_stop_counts ROS_current_stops()
        RETURN [ROS_program_stops_1,ROS_control_asked_1,ROS_control_commands_1];
    ENDFUNC

    ! Publish that everything that is received from now on, from any client, is newer than these stops.
    PROC ROS_publish_stops_seen(ROS_stop_counts stops)
        ROS_program_stops_seen_1 := stops.program;
        ROS_control_stops_seen_1 := stops.control;
    ENDPROC

    PROC ROS_new_trajectory()
        ROS_is_first := TRUE;
        ROS_point_count := 0;
        ROS_point_fault := ROS_REASON_NONE;
        stops_at_start := ROS_stops_before;
        is_replacement := ROS_is_replacing;
        ! Write the number first and repeat it last (see ROS_trajectory in ROS_common).
        ROS_trajectory_1 := ROS_next_count(ROS_trajectory_1);
        IF ROS_program_number_1 = ROS_trajectory_1 ROS_program_number_1 := -1;
        ROS_received_1 := 0;
        ROS_refusal_code_1 := ROS_REASON_NONE;
        ROS_refused_point_1 := -1;
        ROS_phase_1 := ROS_TRAJ_RECEIVING;
        ROS_phase_trajectory_1 := ROS_trajectory_1;
        ROS_new_point.trajectory := ROS_trajectory_1;
        ROS_new_point.dwell := FALSE;
    ENDPROC

    ! Return TRUE if the control server has asked for a stop since the first byte of the trajectory arrived.
    LOCAL FUNC bool is_stopped_by_control()
        IF is_replacement RETURN ROS_control_commands_1 <> stops_at_start.commands;
        RETURN ROS_control_asked_1 <> stops_at_start.control;
    ENDFUNC

    ! From now on the motion task executes the points of this trajectory and of no other.
    PROC ROS_start_motion()
        ROS_phase_1 := ROS_TRAJ_MOVING;
        ROS_active_trajectory_1 := ROS_trajectory_1;
        ! A later stop finds the trajectory active and halts it. A stop that came before this is handled
        ! here.
        IF is_stopped_by_control() ROS_end_trajectory ROS_control_reason_1;
        IF ROS_program_stops_1 <> stops_at_start.program THEN
            ROS_end_trajectory ROS_stop_cause(ROS_REASON_PROGRAM_STOPPED);
            ! The points are put into the ring buffer only after the robot has been stopped.
            ROS_wait_halted;
        ENDIF
    ENDPROC

    ! Checks of a point. Each check accepts values inside a range, so NaN is rejected.

    PROC ROS_set_fault(num code)
        IF ROS_point_fault = ROS_REASON_NONE ROS_point_fault := code;
    ENDPROC

    ! Only the first point may have a duration of zero. Every duration must be a number.
    PROC ROS_check_duration()
        IF ROS_duration = 0 AND ROS_is_first RETURN;
        ROS_set_fault value_fault(ROS_duration, ROS_REASON_BAD_DURATION);
        ! Continue with a value with which the following checks can compute.
        ROS_duration := ROS_MAX_DURATION;
    ENDPROC

    ! Check a joint that is outside its limits or faster than its axis. Return the value to use: the
    ! limit, if the joint exceeds it only by rounding.
    FUNC num ROS_check_joint(num value, num previous, num joint)
        VAR num lowest;
        VAR num highest;
        VAR num accepted;

        lowest := ROS_low{joint};
        highest := ROS_high{joint};
        accepted := value;
        IF lowest - ROUNDING_TOL <= value AND value < lowest accepted := lowest;
        IF highest < value AND value <= highest + ROUNDING_TOL accepted := highest;
        IF NOT (lowest <= accepted AND accepted <= highest)
            ROS_set_fault 100 * joint + value_fault(value, ROS_REASON_JOINT_LIMIT);
        ! The driver itself chooses the speed to the first point.
        IF ROS_is_first OR Abs(accepted - previous) <= ROS_MAX_SPEED{joint} * ROS_duration RETURN accepted;
        ROS_set_fault 100 * joint + ROS_REASON_TOO_FAST;
        RETURN accepted;
    ENDFUNC

    ! Return the reason to reject a value: `reason`, or that the value is not finite.
    LOCAL FUNC num value_fault(num value, num reason)
        IF -ROS_MAX_FINITE <= value AND value <= ROS_MAX_FINITE RETURN reason;
        RETURN ROS_REASON_NOT_FINITE;
    ENDFUNC

    ! Compute the time to the first point (`approach_time`, s), 0 if the robot stands there. `joint`
    ! must be 0; it becomes the first joint that is too far from the first point.
    PROC ROS_check_start(jointtarget current, jointtarget start, INOUT num approach_time,
        INOUT num joint)
        approach_time := 0;
        check_start_axis Abs(start.robax.rax_1 - current.robax.rax_1), 1, approach_time, joint;
        check_start_axis Abs(start.robax.rax_2 - current.robax.rax_2), 2, approach_time, joint;
        check_start_axis Abs(start.robax.rax_3 - current.robax.rax_3), 3, approach_time, joint;
        check_start_axis Abs(start.robax.rax_4 - current.robax.rax_4), 4, approach_time, joint;
        check_start_axis Abs(start.robax.rax_5 - current.robax.rax_5), 5, approach_time, joint;
        check_start_axis Abs(start.robax.rax_6 - current.robax.rax_6), 6, approach_time, joint;
        check_start_axis Abs(start.extax.eax_a - current.extax.eax_a), 7, approach_time, joint;
        check_start_axis Abs(start.extax.eax_b - current.extax.eax_b), 8, approach_time, joint;
    ENDPROC

    LOCAL PROC check_start_axis(num travel, num n, INOUT num approach_time, INOUT num joint)
        IF joint = 0 AND travel > START_TOL{n} joint := n;
        IF travel <= AT_TARGET_TOL RETURN;
        IF approach_time < ROS_MIN_SEGMENT approach_time := ROS_MIN_SEGMENT;
        IF approach_time < travel / (ROS_MAX_SPEED{n} * APPROACH_FACTOR)
            approach_time := travel / (ROS_MAX_SPEED{n} * APPROACH_FACTOR);
    ENDPROC

    ! Ask the supervisor whether the trajectory may start, and wait for a halt in progress (HALT_CHECKS
    ! times HALT_PERIOD at most). Return 0 or the reason against a start.
    FUNC num ROS_blocker()
        FOR try FROM 1 TO HALT_CHECKS DO
            ! A stop after the first byte of the trajectory also applies to this trajectory.
            IF is_stopped_by_control() RETURN ROS_control_reason_1;
            ! The supervisor waits until such a stop is known to be older than what may move the robot.
            IF is_replacement ROS_control_stops_seen_1 := ROS_control_asked_1;
            ! The same holds for a condition that has forbidden motion meanwhile, even if it is over.
            ROS_check_asked_1 := ROS_next_count(ROS_check_asked_1);
            IF ROS_supervisor_missing RETURN ROS_REASON_TASK_ENDED;
            IF NOT ROS_wait_answered(ROS_REPLY_TIMEOUT) THEN
                IF ROS_supervisor_missing RETURN ROS_REASON_TASK_ENDED;
                RETURN ROS_REASON_INTERNAL;
            ENDIF
            IF ROS_not_ready_1 > ROS_REASON_NONE RETURN ROS_not_ready_1;
            IF ROS_blocked_1 = ROS_trajectory_1 RETURN ROS_blocker_code_1;
            ! The same holds for a stop that was over before the supervisor could notice it.
            IF ROS_program_stops_1 <> stops_at_start.program RETURN ROS_stop_cause(ROS_REASON_PROGRAM_STOPPED);
            IF ROS_not_ready_1 = ROS_REASON_NONE RETURN ROS_REASON_NONE;
            WaitTime HALT_PERIOD;
        ENDFOR
        RETURN ROS_REASON_NOT_EXECUTING;
    ENDFUNC

    ! Wait until the supervisor has answered all requests. Return FALSE if this takes longer than
    ! `seconds`.
    FUNC bool ROS_wait_answered(num seconds)
        FOR try FROM 1 TO ROS_ANSWER_CHECKS * seconds DO
            IF ROS_stop_done_1 = ROS_stop_asked_1 AND ROS_check_done_1 = ROS_check_asked_1 RETURN TRUE;
            WaitTime ROS_ANSWER_PERIOD;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    ! Request a halt if a trajectory is active.
    PROC ROS_end_trajectory(num reason)
        ROS_feed_total := ROS_feed_count;
        IF NOT ROS_is_active() RETURN;
        ROS_stop_reason_1 := reason;
        ROS_stop_asked_1 := ROS_next_count(ROS_stop_asked_1);
    ENDPROC

    ! Wait for the requested halt. Without an answer this task stops the robot and repeats the request,
    ! because the supervisor may have answered just an earlier one.
    PROC ROS_wait_halted()
        IF ROS_wait_answered(ROS_STOP_TIMEOUT) RETURN;
        IF ROS_fallback_stop() ROS_stop_asked_1 := ROS_next_count(ROS_stop_asked_1);
    ENDPROC

    ! STOP discards a trajectory that has not started, and also resets the error of a refused one.
    PROC ROS_discard_trajectory()
        IF ROS_phase_1 <> ROS_TRAJ_RECEIVING AND ROS_phase_1 <> ROS_TRAJ_REFUSED RETURN;
        ROS_refusal_code_1 := ROS_REASON_STOPPED;
        ROS_phase_1 := ROS_TRAJ_STOPPED;
    ENDPROC

    ! Refuse the whole trajectory. `code` is reason + 100 * joint; `index` is the faulty point from 0,
    ! or -1.
    PROC ROS_refuse(num code, num index)
        ROS_refused_point_1 := index;
        ROS_refusal_code_1 := code;
        ROS_phase_1 := ROS_TRAJ_REFUSED;
        ROS_report_refusal code, index;
    ENDPROC

    ! Write at most one warning in REPORT_PERIOD to the event log. Nothing is written on the pendant, because
    ! that may delay this task, which also receives STOP.
    PROC ROS_report_refusal(num code, num index)
        VAR string text := "";

        IF clock_running AND ROS_elapsed_seconds(clock_report) < REPORT_PERIOD THEN
            unreported := unreported + 1;
            RETURN;
        ENDIF
        IF index >= 0 text := "Point " + ValToStr(index) + ". ";
        IF code DIV 100 > 0 text := text + "Joint " + ValToStr(code DIV 100) + ". ";
        IF unreported > 0 text := text + ValToStr(unreported) + " similar ones.";
        unreported := 0;
        ErrWrite \W, "ROS: trajectory refused", ROS_reason_text(code MOD 100) \RL2:=text;
        ROS_start_clock clock_report;
        clock_running := TRUE;
    ENDPROC

    ! ---- Trajectories that are sent as a whole ----

    ! Handle the point with the number `sequence` at byte `at` of `data`.
    PROC ROS_handle_point(VAR rawbytes data, num at, num sequence)
        IF sequence = ROS_SEQ_START_DOWNLOAD begin_download;
        IF skipping THEN
            IF sequence = ROS_SEQ_END skipping := FALSE;
        ELSEIF NOT ROS_receiving THEN
            ROS_new_trajectory;
            ROS_refuse_download ROS_REASON_NO_START, 0, sequence = ROS_SEQ_END;
        ELSEIF sequence = ROS_point_count OR sequence = ROS_SEQ_END OR ROS_point_count = 0 THEN
            ROS_add_point data, at, sequence;
            IF ROS_receiving AND sequence = ROS_SEQ_END start_motion;
        ELSE
            ROS_refuse_download ROS_REASON_SEQUENCE_GAP, ROS_point_count, FALSE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! Check the point at byte `at` of `data` and add it. Refuse the trajectory if the point is wrong.
    PROC ROS_add_point(VAR rawbytes data, num at, num sequence)
        VAR num joint_1;
        VAR num joint_2;
        VAR num joint_3;
        VAR num joint_4;
        VAR num joint_5;
        VAR num joint_6;
        VAR num joint_7;
        VAR num joint_8;
        VAR num padding;

        IF ROS_point_count >= ROS_CAPACITY THEN
            ROS_refuse_download ROS_REASON_CAPACITY, ROS_point_count, sequence = ROS_SEQ_END;
            RETURN;
        ENDIF
        ROS_previous := ROS_new_point.target;
        UnpackRawBytes data, at + 64, ROS_duration \Float4;
        IF NOT (0 < ROS_duration AND ROS_duration <= ROS_MAX_DURATION) ROS_check_duration;
        UnpackRawBytes data, at + 20, joint_1 \Float4;
        joint_1 := joint_1 * ROS_DEG;
        UnpackRawBytes data, at + 24, joint_2 \Float4;
        joint_2 := joint_2 * ROS_DEG;
        UnpackRawBytes data, at + 28, joint_3 \Float4;
        joint_3 := joint_3 * ROS_DEG;
        UnpackRawBytes data, at + 32, joint_4 \Float4;
        joint_4 := joint_4 * ROS_DEG;
        UnpackRawBytes data, at + 36, joint_5 \Float4;
        joint_5 := joint_5 * ROS_DEG;
        UnpackRawBytes data, at + 40, joint_6 \Float4;
        joint_6 := joint_6 * ROS_DEG;
        UnpackRawBytes data, at + 44, joint_7 \Float4;
        joint_7 := joint_7 * ROS_MM;
        UnpackRawBytes data, at + 48, joint_8 \Float4;
        joint_8 := joint_8 * ROS_DEG;
        ! A joint that is correct passes ROS_check_joint, too.
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1}
            AND Abs(joint_1 - ROS_previous.robax.rax_1) <= ROS_MAX_SPEED{1} * ROS_duration
            AND ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2}
            AND Abs(joint_2 - ROS_previous.robax.rax_2) <= ROS_MAX_SPEED{2} * ROS_duration
            AND ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3}
            AND Abs(joint_3 - ROS_previous.robax.rax_3) <= ROS_MAX_SPEED{3} * ROS_duration
            AND ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4}
            AND Abs(joint_4 - ROS_previous.robax.rax_4) <= ROS_MAX_SPEED{4} * ROS_duration
            AND ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5}
            AND Abs(joint_5 - ROS_previous.robax.rax_5) <= ROS_MAX_SPEED{5} * ROS_duration
            AND ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6}
            AND Abs(joint_6 - ROS_previous.robax.rax_6) <= ROS_MAX_SPEED{6} * ROS_duration
            AND ROS_low{7} <= joint_7 AND joint_7 <= ROS_high{7}
            AND Abs(joint_7 - ROS_previous.extax.eax_a) <= ROS_MAX_SPEED{7} * ROS_duration
            AND ROS_low{8} <= joint_8 AND joint_8 <= ROS_high{8}
            AND Abs(joint_8 - ROS_previous.extax.eax_b) <= ROS_MAX_SPEED{8} * ROS_duration) THEN
            joint_1 := ROS_check_joint(joint_1, ROS_previous.robax.rax_1, 1);
            joint_2 := ROS_check_joint(joint_2, ROS_previous.robax.rax_2, 2);
            joint_3 := ROS_check_joint(joint_3, ROS_previous.robax.rax_3, 3);
            joint_4 := ROS_check_joint(joint_4, ROS_previous.robax.rax_4, 4);
            joint_5 := ROS_check_joint(joint_5, ROS_previous.robax.rax_5, 5);
            joint_6 := ROS_check_joint(joint_6, ROS_previous.robax.rax_6, 6);
            joint_7 := ROS_check_joint(joint_7, ROS_previous.extax.eax_a, 7);
            joint_8 := ROS_check_joint(joint_8, ROS_previous.extax.eax_b, 8);
        ENDIF
        ! Joints that this robot does not have must be zero.
        UnpackRawBytes data, at + 52, padding \Float4;
        IF NOT (padding = 0) ROS_set_fault 100 * 9 + ROS_REASON_BAD_PADDING;
        UnpackRawBytes data, at + 56, padding \Float4;
        IF NOT (padding = 0) ROS_set_fault 100 * 10 + ROS_REASON_BAD_PADDING;

        ROS_new_point.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],
            [joint_7,joint_8,9E9,9E9,9E9,9E9]];
        IF ROS_is_first THEN
            ROS_is_first := FALSE;
        ELSE
            IF ROS_duration < ROS_MIN_SEGMENT AND sequence <> ROS_SEQ_END
                ROS_set_fault ROS_REASON_SEGMENT_TOO_SHORT;
            ! A point at the same place again means: stand still for the duration.
            ROS_new_point.dwell := (ROS_new_point.target = ROS_previous);
        ENDIF
        IF ROS_point_fault <> ROS_REASON_NONE THEN
            ROS_refuse_download ROS_point_fault, ROS_point_count, sequence = ROS_SEQ_END;
            RETURN;
        ENDIF
        ROS_point_count := ROS_point_count + 1;
        ROS_new_point.index := ROS_point_count;
        ROS_new_point.duration := ROS_duration;
        points{ROS_point_count} := ROS_new_point;
        ROS_received_1 := ROS_point_count;
    ERROR
        RAISE;
    ENDPROC

    ! Write points into the ring buffer while there are free places, and announce them afterwards. Close
    ! the trajectory after its last point.
    PROC ROS_feed_ring()
        VAR num head;
        VAR num free_places;

        head := ROS_head_1;
        free_places := ROS_RING_SIZE - 1 - ROS_ring_count();
        WHILE free_places > 0 AND ROS_feed_count < ROS_feed_total DO
            ROS_feed_count := ROS_feed_count + 1;
            ROS_ring_1{head MOD ROS_RING_SIZE + 1} := points{ROS_feed_count};
            head := ROS_next_count(head);
            free_places := free_places - 1;
        ENDWHILE
        ROS_head_1 := head;
        IF NOT ROS_is_active() THEN
            ! The trajectory has ended before all of its points were in the ring buffer.
            ROS_feed_total := ROS_feed_count;
        ELSEIF ROS_feed_count = ROS_feed_total THEN
            ROS_closed_code_1 := ROS_REASON_NONE;
            ROS_closed_trajectory_1 := ROS_active_trajectory_1;
        ENDIF
    ENDPROC

    ! The client has sent STOP. Points without an end frame are not a trajectory.
    PROC ROS_discard_download()
        ROS_receiving := FALSE;
        skipping := FALSE;
    ENDPROC

    ! The client has disconnected.
    PROC ROS_drop_download()
        IF ROS_receiving ROS_refuse_download ROS_REASON_INCOMPLETE, ROS_point_count, TRUE;
        skipping := FALSE;
    ENDPROC

    ! Refuse the trajectory that is being received. Skip what follows, unless this was its end.
    PROC ROS_refuse_download(num code, num index, bool is_ended)
        ROS_receiving := FALSE;
        skipping := NOT is_ended;
        ROS_refuse code, index;
    ENDPROC

    LOCAL PROC begin_download()
        ROS_begin_trajectory;
        ROS_receiving := (ROS_phase_1 = ROS_TRAJ_RECEIVING);
        skipping := NOT ROS_receiving;
    ENDPROC

    ! The end frame has arrived and all points were accepted. Start the trajectory if the robot may move
    ! and stands at its first point.
    LOCAL PROC start_motion()
        VAR num blocker;
        VAR jointtarget current;
        VAR num approach_time := 0;
        VAR num joint := 0;

        blocker := ROS_blocker();
        IF blocker <> ROS_REASON_NONE THEN
            ROS_refuse_download blocker, -1, TRUE;
            RETURN;
        ENDIF
        current := CJointT();
        ! The client's duration for the first point is not used. It is 10 s if its time stamp is zero,
        ! else the difference to a time stamp of the previous trajectory.
        ROS_check_start current, points{1}.target, approach_time, joint;
        IF joint > 0 THEN
            ROS_refuse_download 100 * joint + ROS_REASON_START_TOO_FAR, 0, TRUE;
            RETURN;
        ENDIF
        IF ROS_point_count = 2 AND points{2}.dwell THEN
            ! A single point, sent as first and last one, is a target, not a place to stand still. The
            ! longer of the two durations counts.
            IF points{2}.duration > approach_time approach_time := points{2}.duration;
            points{2}.duration := 0;
        ENDIF
        points{1}.duration := approach_time;
        ROS_receiving := FALSE;
        ROS_feed_count := 0;
        ROS_feed_total := ROS_point_count;
        ROS_start_motion;
    ENDPROC
ENDMODULE
