MODULE ROS_motionServer
    ! The motion server: the port for trajectories and STOP.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! A trajectory comes whole, as points -1, 1, 2, ..., -3 (ROS_download), or in batches without
    ! end (ROS_stream). The client's STOP lies in the same stream of bytes behind its points, so
    ! this task never waits for room: it reads, and feeds the ring in between.

    CONST string ROS_BUILD_MOTION_SERVER := "8a237425283c";

    LOCAL CONST num PORT := 11000;
    ! s between two looks for bytes while the ring is being fed
    LOCAL CONST num LOOK_PERIOD := 0.008;
    ! s of silence after which a newer client is served, unless a trajectory is under way
    LOCAL CONST num PATIENCE := 1;
    ! s between two looks for newer clients
    LOCAL CONST num NEWCOMER_PERIOD := 0.1;

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! The other socket already holds the next client.
    LOCAL VAR bool taken_over := FALSE;
    LOCAL VAR bool linked := FALSE;
    ! The other socket holds a newer client, who waits, and what it has said so far.
    LOCAL VAR bool waiting := FALSE;
    LOCAL VAR rawbytes early;
    LOCAL VAR num early_bytes := 0;
    LOCAL VAR clock since_look;
    ! Stops that came before all that the newer client has sent, and before any client came who has
    ! not been accepted yet.
    LOCAL VAR ROS_stop_counts stops_before_newcomer;
    LOCAL VAR ROS_stop_counts stops_before_others;
    LOCAL VAR rawbytes answer;
    ! Of the message at hand: what it asks for, its reply code, and the number of a point.
    LOCAL VAR num comm_type := 0;
    LOCAL VAR num reply_code := 0;
    LOCAL VAR bool requested := FALSE;
    LOCAL VAR num sequence := 0;

    PROC main()
        ROS_start_task ROS_shown_motion_server,
            ROS_BUILD_LIMITS = ROS_BUILD_ID AND ROS_BUILD_MESSAGES = ROS_BUILD_ID AND
            ROS_BUILD_SOCKET = ROS_BUILD_ID AND ROS_BUILD_ACCEPTANCE = ROS_BUILD_ID AND
            ROS_BUILD_DOWNLOAD = ROS_BUILD_ID AND ROS_BUILD_INSTRUCTIONS = ROS_BUILD_ID AND
            ROS_BUILD_PROGRAMS = ROS_BUILD_ID AND ROS_BUILD_STREAM = ROS_BUILD_ID AND
            ROS_BUILD_MOTION_SERVER = ROS_BUILD_ID;
        ROS_begin_pulse 1;
        ROS_read_limits \tell;
        ! Counters start where those that answer them stand.
        ROS_head := ROS_tail;
        ROS_closed := -1;
        ROS_phase := ROS_TRAJ_NONE;
        ROS_phase_of := ROS_trajectory;
        ROS_end_session ROS_REASON_CLIENT_LOST;
        ROS_listen server, PORT;
        stops_before_others := ROS_stops_now();
        WHILE TRUE DO
            serve client_1, client_2;
            lose client_1;
            serve client_2, client_1;
            lose client_2;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it is gone, or until a newer one has come on `newcomer`.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received;
        VAR num quiet := 0;
        VAR bool busy;

        IF NOT taken_over THEN
            WHILE NOT has_come(client, ROS_WAIT) DO
                ! Nobody, a stranger, or the server socket broke and was opened again.
                ROS_show_stops_seen stops_before_others;
            ENDWHILE
        ENDIF
        taken_over := FALSE;
        linked := TRUE;
        ROS_part_bytes := 0;
        ROS_start_clock since_look;
        ROS_stops_before := stops_before_newcomer;
        ROS_show_stops_seen ROS_stops_before;
        ! What it said while another one was served.
        received := early_bytes;
        early_bytes := 0;
        IF received > 0 THEN
            CopyRawBytes early, 1, ROS_chunk, 1 \NoOfBytes:=received;
            take_chunk client, received;
        ENDIF
        WHILE linked AND (NOT taken_over) DO
            busy := ROS_active();
            note_stops client, newcomer;
            IF ROS_fed < ROS_to_feed THEN
                ROS_feed;
                received := short_look(client);
                quiet := quiet + LOOK_PERIOD;
            ELSE
                received := ROS_receive(client, ROS_chunk, ROS_WAIT);
                quiet := quiet + ROS_WAIT;
            ENDIF
            ! Silence counts from the end of what was under way.
            IF received <> 0 OR (busy AND (NOT ROS_active())) quiet := 0;
            IF received > 0 THEN
                take_chunk client, received;
            ELSEIF received < 0 THEN
                linked := FALSE;
            ENDIF
            IF linked AND ROS_elapsed(since_look) >= NEWCOMER_PERIOD look_at newcomer, quiet;
        ENDWHILE
    ERROR
        ! Nothing that a client sends may end this task.
        ErrWrite \W, "ROS: a client was dropped", "Error " + ValToStr(ERRNO) + " while serving it.";
        RETURN;
    ENDPROC

    ! TRUE if a client has come on `client` within `seconds`.
    LOCAL FUNC bool has_come(VAR socketdev client, num seconds)
        VAR ROS_stop_counts stops;

        stops := ROS_stops_now();
        IF ROS_accept(server, PORT, client, seconds) THEN
            stops_before_newcomer := stops_before_others;
            RETURN TRUE;
        ENDIF
        ! Who comes now has sent nothing before these stops.
        IF ROS_nobody stops_before_others := stops;
        RETURN FALSE;
    ENDFUNC

    ! What has been received before a stop must not move the robot: stops are known when nothing is left
    ! to read. They are shown as seen when they are known of every client.
    LOCAL PROC note_stops(VAR socketdev client, VAR socketdev newcomer)
        VAR ROS_stop_counts stops;

        stops := ROS_stops_now();
        IF stops = ROS_stops_before OR ROS_part_bytes > 0 RETURN;
        IF ROS_peek(client) = 0 ROS_stops_before := stops;
        IF ROS_stops_before <> stops RETURN;
        IF NOT waiting waiting := has_come(newcomer, 0.001);
        ROS_show_stops_seen stops;
    ENDPROC

    ! A newer client is served when this one has been silent for a while: it may be the same
    ! one, whose old link is dead without a word. While a trajectory is under way that its client
    ! is silent means nothing, and to connect is no reason to stop the robot.
    LOCAL PROC look_at(VAR socketdev newcomer, num quiet)
        VAR num wish;
        VAR ROS_stop_counts stops;

        ROS_start_clock since_look;
        IF NOT waiting waiting := has_come(newcomer, 0.001);
        IF NOT waiting RETURN;
        stops := ROS_stops_now();
        IF early_bytes = 0 THEN
            IF ROS_peek(newcomer) = 0 stops_before_newcomer := stops;
        ENDIF
        IF NOT ROS_active() THEN
            taken_over := (quiet >= PATIENCE);
            RETURN;
        ENDIF
        wish := heard(newcomer);
        IF wish = ROS_REASON_FRAMING THEN
            SocketClose newcomer;
            waiting := FALSE;
            early_bytes := 0;
        ELSEIF wish <> ROS_REASON_NONE THEN
            ROS_end_session wish;
            taken_over := TRUE;
        ENDIF
    ENDPROC

    ! Who waits may stop what is under way, and begin something else; nothing else counts yet. What its
    ! first message that says STOP or brings points is for the trajectory under way: STOPPED or
    ! SUPERSEDED; FRAMING: it is none, or too much came before it, or the link is lost; 0: there is none yet.
    LOCAL FUNC num heard(VAR socketdev newcomer)
        VAR rawbytes more;
        VAR num bytes;
        VAR num at := 1;
        VAR num length;
        VAR num kind;
        VAR num number;

        bytes := ROS_peek(newcomer);
        IF bytes > 0 bytes := ROS_receive(newcomer, more, 0.01);
        IF bytes = 0 RETURN ROS_REASON_NONE;
        IF bytes < 0 RETURN ROS_REASON_FRAMING;
        CopyRawBytes more, 1, early, early_bytes + 1 \NoOfBytes:=bytes;
        early_bytes := early_bytes + bytes;
        WHILE at + ROS_HEADER_BYTES + 7 <= early_bytes DO
            UnpackRawBytes early, at, length \IntX:=DINT;
            UnpackRawBytes early, at + 4, kind \IntX:=DINT;
            IF NOT (ROS_HEADER_BYTES <= length AND length <= ROS_MAX_LENGTH) RETURN ROS_REASON_FRAMING;
            IF at + length + 3 > early_bytes RETURN ROS_REASON_NONE;
            IF kind = ROS_MSG_POINTS OR kind = ROS_MSG_PROGRAM RETURN ROS_REASON_SUPERSEDED;
            IF kind = ROS_MSG_JOINT_TRAJ_PT THEN
                UnpackRawBytes early, at + 16, number \IntX:=DINT;
                IF number = ROS_SEQ_STOP RETURN ROS_REASON_STOPPED;
                RETURN ROS_REASON_SUPERSEDED;
            ENDIF
            at := at + length + 4;
        ENDWHILE
        RETURN ROS_REASON_NONE;
    ERROR
        SkipWarn;
        RETURN ROS_REASON_FRAMING;
    ENDFUNC

    ! The robot does not go on for a client that is gone, and half a trajectory is none. Whoever waits
    ! is served next; who has taken over has ended what was under way, and said why.
    LOCAL PROC lose(VAR socketdev client)
        SocketClose client;
        ROS_lose_download;
        ROS_lose_stream;
        IF NOT (taken_over AND ROS_active()) ROS_end_session ROS_REASON_CLIENT_LOST;
        taken_over := waiting;
        waiting := FALSE;
        ROS_await_halt;
    ENDPROC

    ! While the ring is being fed, look for bytes without waiting for them.
    LOCAL FUNC num short_look(VAR socketdev client)
        VAR num here;

        here := ROS_peek(client);
        IF here > 0 RETURN ROS_receive(client, ROS_chunk, PATIENCE);
        IF here = 0 WaitTime LOOK_PERIOD;
        RETURN here;
    ENDFUNC

    LOCAL PROC take_chunk(VAR socketdev client, num received)
        ROS_take_bytes received;
        WHILE linked DO
            TEST ROS_next_frame()
            CASE ROS_FRAME_IN_CHUNK:
                take_message client, ROS_chunk, ROS_frame_at;
            CASE ROS_FRAME_IN_PART:
                take_message client, ROS_part, 1;
            CASE ROS_FRAME_BROKEN:
                broken_framing;
            DEFAULT:
                RETURN;
            ENDTEST
        ENDWHILE
    ERROR
        RAISE;
    ENDPROC

    ! The message that begins at byte `at` of `data`.
    LOCAL PROC take_message(VAR socketdev client, VAR rawbytes data, num at)
        UnpackRawBytes data, at + 8, comm_type \IntX:=DINT;
        UnpackRawBytes data, at + 12, reply_code \IntX:=DINT;
        IF ROS_frame_type = ROS_MSG_JOINT_TRAJ_PT AND ROS_frame_length = ROS_LEN_JOINT_TRAJ_PT THEN
            UnpackRawBytes data, at + 16, sequence \IntX:=DINT;
            IF ROS_receiving AND sequence = ROS_count AND comm_type = ROS_COMM_TOPIC
                AND reply_code = ROS_REPLY_NONE THEN
                ! The usual case first.
                ROS_add_point data, at, sequence;
            ELSEIF NOT knows_kind() THEN
                broken_framing;
            ELSEIF sequence = ROS_SEQ_STOP THEN
                stop_now client;
            ELSE
                ROS_take_point data, at, sequence;
                IF requested answer_point client;
            ENDIF
        ELSEIF ROS_frame_type = ROS_MSG_POINTS OR ROS_frame_type = ROS_MSG_PROGRAM THEN
            IF NOT knows_kind() THEN
                broken_framing;
                RETURN;
            ENDIF
            ROS_take_batch data, at;
            IF requested answer_batch client;
        ELSE
            take_other client;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! TRUE for a topic or a request without a reply code. Anything else breaks the framing.
    LOCAL FUNC bool knows_kind()
        requested := (comm_type = ROS_COMM_REQUEST);
        RETURN reply_code = ROS_REPLY_NONE AND (requested OR comm_type = ROS_COMM_TOPIC);
    ENDFUNC

    ! Where the next message begins is not known any more, so nothing behind it can be trusted.
    LOCAL PROC broken_framing()
        IF ROS_receiving THEN
            ROS_refuse_download ROS_REASON_FRAMING, ROS_count, FALSE;
        ELSE
            ROS_report ROS_REASON_FRAMING, -1;
        ENDIF
        linked := FALSE;
    ENDPROC

    ! A message that brings no points.
    LOCAL PROC take_other(VAR socketdev client)
        IF ROS_frame_type = ROS_MSG_JOINT_TRAJ_PT THEN
            ! A point of another size: what else would be wrong?
            broken_framing;
        ELSEIF ROS_frame_type = ROS_MSG_PING THEN
            IF comm_type = ROS_COMM_REQUEST reply client, ROS_frame_type, ROS_REPLY_SUCCESS;
        ELSE
            ROS_report ROS_REASON_UNKNOWN_MESSAGE, -1;
            IF comm_type = ROS_COMM_REQUEST reply client, ROS_frame_type, ROS_REPLY_FAILURE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC reply(VAR socketdev client, num kind, num code)
        ROS_pack_reply answer, kind, code;
        linked := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    ! A request is answered by what has become of the trajectory so far.
    LOCAL PROC answer_point(VAR socketdev client)
        IF ROS_phase = ROS_TRAJ_REFUSED THEN
            ROS_pack_refused answer, ROS_refusal, ROS_refused_at;
        ELSEIF ROS_phase = ROS_TRAJ_MOVING AND sequence = ROS_SEQ_END THEN
            ROS_pack_accepted answer, ROS_trajectory;
        ELSE
            ROS_pack_reply answer, ROS_MSG_JOINT_TRAJ_PT, ROS_REPLY_SUCCESS;
        ENDIF
        linked := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC answer_batch(VAR socketdev client)
        ROS_pack_batch_reply answer;
        linked := ROS_send(client, answer);
    ERROR
        RAISE;
    ENDPROC

    ! STOP: the reply comes when the robot has been told to stop, not when it stands. Points
    ! of this trajectory that are still under way count as sent without a start.
    LOCAL PROC stop_now(VAR socketdev client)
        VAR num code := ROS_REPLY_SUCCESS;

        ROS_forget_download;
        ROS_forget_trajectory;
        ROS_end_session ROS_REASON_STOPPED;
        IF ROS_service = ROS_OUTSIDE THEN
            ! The supervisor tells that the program's own moves go on.
            ROS_stop_reason := ROS_REASON_STOPPED;
            ROS_stop_asked := ROS_next(ROS_stop_asked);
        ENDIF
        ROS_await_halt;
        IF NOT ROS_answered(ROS_LATE - ROS_SOON) code := ROS_REPLY_FAILURE;
        IF requested reply client, ROS_MSG_JOINT_TRAJ_PT, code;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
