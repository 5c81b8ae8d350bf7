MODULE ROS_motionServer
    ! The motion server: the port for trajectories and STOP.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! A trajectory is sent as a whole, as points -1, 1, 2, ..., -3
    ! (ROS_download), or in batches of any number
    ! (ROS_stream). The client sends STOP behind its points on the same connection. This
    ! task therefore never waits for free places in the ring buffer: it reads, and feeds the ring buffer
    ! in between.

    CONST string ROS_BUILD_MOTION_SERVER := "e6da4508cd5b";

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
    LOCAL VAR num sequence := 0;

    PROC main()
        ROS_start_task ROS_task_build_motion_server,
            ROS_BUILD_LIMITS = ROS_BUILD_ID AND ROS_BUILD_MESSAGES = ROS_BUILD_ID AND
            ROS_BUILD_SOCKET = ROS_BUILD_ID AND ROS_BUILD_ACCEPTANCE = ROS_BUILD_ID AND
            ROS_BUILD_DOWNLOAD = ROS_BUILD_ID AND ROS_BUILD_INSTRUCTIONS = ROS_BUILD_ID AND
            ROS_BUILD_PROGRAMS = ROS_BUILD_ID AND ROS_BUILD_STREAM = ROS_BUILD_ID AND
            ROS_BUILD_MOTION_SERVER = ROS_BUILD_ID;
        ROS_start_alive_count 1;
        ROS_read_limits \log;
        ! Initialise the counters to the values of those that answer them.
        ROS_head := ROS_tail;
        ROS_closed_trajectory := -1;
        ROS_phase := ROS_TRAJ_NONE;
        ROS_phase_trajectory := ROS_trajectory;
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
        IF stops <> stops_before_others seconds := 0.001;
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
        IF NOT has_newcomer has_newcomer := accept_client(newcomer, 0.001);
        ROS_publish_stops_seen stops;
    ENDPROC

    ! Serve a newer client after the present one has been silent for a while: it may be the same client,
    ! whose old connection is broken without notice. During a trajectory the silence of its client means
    ! nothing, and a new connection is no reason to stop the robot.
    LOCAL PROC check_newcomer(VAR socketdev newcomer, num silence)
        VAR num reason;
        VAR ROS_stop_counts stops;

        ROS_start_clock clock_accept;
        IF NOT has_newcomer has_newcomer := accept_client(newcomer, 0.001);
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
        IF bytes > 0 bytes := ROS_receive(newcomer, received_data, 0.01);
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
        IF available > 0 RETURN ROS_receive(client, ROS_chunk, TAKEOVER_DELAY);
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
            UnpackRawBytes data, at + 16, sequence \IntX:=DINT;
            IF ROS_receiving AND sequence = ROS_point_count AND comm_type = ROS_COMM_TOPIC
                AND reply_code = ROS_REPLY_NONE THEN
                ! This is the most frequent case, so it is tested first.
                ROS_add_point data, at, sequence;
            ELSEIF NOT is_valid_comm() THEN
                reject_framing;
            ELSEIF sequence = ROS_SEQ_STOP THEN
                handle_stop client;
            ELSE
                ROS_handle_point data, at, sequence;
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
        IF ROS_phase = ROS_TRAJ_REFUSED THEN
            ROS_pack_refused answer, ROS_refusal_code, ROS_refused_point;
        ELSEIF ROS_phase = ROS_TRAJ_MOVING AND sequence = ROS_SEQ_END THEN
            ROS_pack_accepted answer, ROS_trajectory;
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
        IF ROS_run_state = ROS_RUN_OUTSIDE THEN
            ! The supervisor reports that the moves of the program itself continue.
            ROS_stop_reason := ROS_REASON_STOPPED;
            ROS_stop_asked := ROS_next_count(ROS_stop_asked);
        ENDIF
        ROS_wait_halted;
        IF NOT ROS_wait_answered(ROS_REPLY_TIMEOUT - ROS_STOP_TIMEOUT) code := ROS_REPLY_FAILURE;
        IF is_request send_reply client, ROS_MSG_JOINT_TRAJ_PT, code;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
