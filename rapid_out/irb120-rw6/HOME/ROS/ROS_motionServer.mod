MODULE ROS_motionServer
    ! The motion server: receives trajectories, checks them, hands them over.
    !
    ! Robot "irb120-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! A trajectory comes as points -1, 1, 2, ..., -3. Each is checked when it comes; nothing
    ! is handed over before -3 has come and everything was right. Then the points go through
    ! the ring to the motion task. The client's STOP lies in the same stream behind its points,
    ! so this task never waits for room: it reads, and feeds the ring in between.

    CONST string ROS_BUILD_MOTION_SERVER := "cb6a054a433e";

    LOCAL CONST num PORT := 11000;
    ! s between two looks for bytes while the ring is being fed
    LOCAL CONST num LOOK_PERIOD := 0.008;
    ! s: longest duration of a point
    LOCAL CONST num LONGEST := 3600;
    ! s: shortest duration that the path planner follows through a corner
    LOCAL CONST num SHORTEST := 0.1;
    ! Fraction of an axis' speed on the way to the first point
    LOCAL CONST num APPROACH := 0.1;
    ! The robot stands at a point if no axis is farther from it than this (deg, mm).
    LOCAL CONST num THERE := 0.01;
    ! A value this near outside a limit is the limit, rounded on its way (deg, mm).
    LOCAL CONST num ROUNDING := 0.0005;

    ! Of each joint: the speed that a segment may ask for (deg/s, mm/s), and how far from the
    ! first point the robot may stand (deg, mm).
    LOCAL CONST num SPEED_1 := 250.25;
    LOCAL CONST num NEAR_1 := 0.5;
    LOCAL CONST num SPEED_2 := 250.25;
    LOCAL CONST num NEAR_2 := 0.5;
    LOCAL CONST num SPEED_3 := 250.25;
    LOCAL CONST num NEAR_3 := 0.5;
    LOCAL CONST num SPEED_4 := 320.32;
    LOCAL CONST num NEAR_4 := 0.5;
    LOCAL CONST num SPEED_5 := 320.32;
    LOCAL CONST num NEAR_5 := 0.5;
    LOCAL CONST num SPEED_6 := 420.42;
    LOCAL CONST num NEAR_6 := 0.5;

    ! Two int32 read as one number: the usual head of a point, a topic, a request.
    LOCAL CONST dnum HEAD_POINT := 47244640320;
    LOCAL CONST dnum KIND_TOPIC := 1;
    LOCAL CONST dnum KIND_REQUEST := 2;
    LOCAL CONST dnum NO_BITS := 0;

    LOCAL CONST jointtarget NOWHERE := [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    LOCAL VAR socketdev server;
    LOCAL VAR socketdev client_1;
    LOCAL VAR socketdev client_2;
    ! The other socket already holds the next client.
    LOCAL VAR bool taken_over := FALSE;
    LOCAL VAR bool linked := FALSE;

    ! Bytes as they came, and a message whose beginning came without its end.
    LOCAL VAR rawbytes chunk;
    LOCAL VAR rawbytes part;
    LOCAL VAR num part_bytes := 0;
    LOCAL VAR rawbytes answer;

    ! The trajectory that is being received: its points, and whether it still may become one.
    LOCAL VAR ROS_point points{ROS_CAPACITY};
    LOCAL VAR num count := 0;
    LOCAL VAR bool receiving := FALSE;
    ! The same array once it was handed over: points to put into the ring, and how many are.
    LOCAL VAR num size := 0;
    LOCAL VAR num fed := 0;
    ! What is left of a refused or stopped trajectory is not looked at.
    LOCAL VAR bool skipping := FALSE;

    ! The point at hand and the one before.
    LOCAL VAR ROS_point point;
    LOCAL VAR jointtarget before;
    LOCAL VAR dnum kind := 0;
    LOCAL VAR num sequence := 0;
    LOCAL VAR num seconds := 0;
    LOCAL VAR num value := 0;
    LOCAL VAR bool requested := FALSE;

    ! Lines on the pendant are rationed.
    LOCAL VAR clock since_line;
    LOCAL VAR num silent_lines := 0;
    LOCAL VAR bool clock_runs := FALSE;

    PROC main()
        ROS_start_task ROS_shown_motion_server, ROS_BUILD_MOTION_SERVER
            \third:=ROS_BUILD_MESSAGES \fourth:=ROS_BUILD_SOCKET \fifth:=ROS_BUILD_LIMITS;
        ROS_read_limits \tell;
        ! Counters start where those that answer them stand.
        ROS_head := ROS_tail;
        ROS_phase := ROS_TRAJ_NONE;
        ROS_phase_of := ROS_trajectory;
        end_session ROS_REASON_CLIENT_LOST;
        ROS_listen server, PORT;
        WHILE TRUE DO
            serve client_1, client_2;
            lost_client;
            serve client_2, client_1;
            lost_client;
        ENDWHILE
    ENDPROC

    ! Serve the client on `client` until it is gone, or until a newer one has come on `newcomer`.
    LOCAL PROC serve(VAR socketdev client, VAR socketdev newcomer)
        VAR num received;
        VAR num quiet := 0;

        IF NOT taken_over THEN
            WHILE NOT welcome(client, WAIT_MAX) DO
                ! A stranger, or the server socket broke and was opened again.
            ENDWHILE
        ENDIF
        taken_over := FALSE;
        linked := TRUE;
        part_bytes := 0;
        WHILE linked AND (NOT taken_over) DO
            IF fed < size THEN
                feed;
                received := short_look(client);
                quiet := quiet + LOOK_PERIOD;
            ELSE
                received := ROS_receive(client, chunk, 1);
                quiet := 1;
            ENDIF
            IF received <> 0 THEN
                quiet := 0;
            ELSEIF quiet >= 1 THEN
                quiet := 0;
                ! Silent for a second: a newer client, if there is one, is served instead. It
                ! may be the same one, whose old link is dead without a word.
                taken_over := welcome(newcomer, 0.001);
            ENDIF
            IF received > 0 THEN
                take_chunk client, received;
            ELSEIF received < 0 THEN
                linked := FALSE;
            ENDIF
        ENDWHILE
        SocketClose client;
    ERROR
        ! Nothing that a client sends may end this task.
        ErrWrite \W, "ROS: a client was dropped", "Error " + ValToStr(ERRNO) + " while serving it.";
        SocketClose client;
        RETURN;
    ENDPROC

    LOCAL FUNC bool welcome(VAR socketdev client, num patience)
        TEST ROS_accept(server, client, patience)
        CASE ROS_ACCEPT_CLIENT:
            RETURN TRUE;
        CASE ROS_ACCEPT_BROKEN:
            ROS_listen server, PORT;
            RETURN FALSE;
        DEFAULT:
            RETURN FALSE;
        ENDTEST
    ENDFUNC

    ! The robot does not go on for a client that is gone, and half a trajectory is none.
    LOCAL PROC lost_client()
        refuse ROS_REASON_INCOMPLETE, count;
        skipping := FALSE;
        end_session ROS_REASON_CLIENT_LOST;
    ENDPROC

    ! While the ring is being fed, look for bytes without waiting for them.
    LOCAL FUNC num short_look(VAR socketdev client)
        VAR num waiting;

        waiting := ROS_peek(client);
        IF waiting > 0 RETURN ROS_receive(client, chunk, 1);
        IF waiting = 0 WaitTime LOOK_PERIOD;
        RETURN waiting;
    ENDFUNC

    ! Bytes 1 to `received` of `chunk`: any number of whole messages, and parts of two.
    LOCAL PROC take_chunk(VAR socketdev client, num received)
        VAR dnum head;
        VAR num at := 1;
        VAR num length := 0;
        VAR num rest;

        IF part_bytes > 0 at := take_part(client, received);
        rest := received - at + 1;
        WHILE linked AND rest >= ROS_HEADER_BYTES + 4 DO
            UnpackRawBytes chunk, at, head \IntX:=ULINT;
            IF head = HEAD_POINT THEN
                length := ROS_LEN_JOINT_TRAJ_PT;
            ELSE
                UnpackRawBytes chunk, at, length \IntX:=DINT;
                IF NOT (ROS_HEADER_BYTES <= length AND length <= ROS_MAX_LENGTH) THEN
                    broken_framing;
                    RETURN;
                ENDIF
            ENDIF
            IF rest < length + 4 THEN
                ! The message goes on in the next chunk.
                keep at, rest;
                RETURN;
            ENDIF
            IF head <> HEAD_POINT THEN
                take_other client, chunk, at, length;
            ELSE
                UnpackRawBytes chunk, at + 8, kind \IntX:=ULINT;
                UnpackRawBytes chunk, at + 16, sequence \IntX:=DINT;
                IF receiving AND sequence = count AND kind = KIND_TOPIC THEN
                    ! The usual case first.
                    add_point chunk, at;
                ELSE
                    take_point client, chunk, at;
                ENDIF
            ENDIF
            at := at + length + 4;
            rest := rest - length - 4;
        ENDWHILE
        IF linked AND rest > 0 keep at, rest;
    ENDPROC

    ! Keep `rest` bytes of `chunk` from `at` on as the beginning of a message.
    LOCAL PROC keep(num at, num rest)
        ClearRawBytes part;
        CopyRawBytes chunk, at, part, 1 \NoOfBytes:=rest;
        part_bytes := rest;
        check_part;
    ENDPROC

    ! A wrong length shows in its four bytes; nobody waits for the rest.
    LOCAL PROC check_part()
        VAR num length := 0;

        IF part_bytes < 4 RETURN;
        UnpackRawBytes part, 1, length \IntX:=DINT;
        IF NOT (ROS_HEADER_BYTES <= length AND length <= ROS_MAX_LENGTH) broken_framing;
    ENDPROC

    ! Complete the message in `part` from the chunk and take it. Gives the first byte of the
    ! chunk that does not belong to it.
    LOCAL FUNC num take_part(VAR socketdev client, num received)
        VAR num at := 1;
        VAR num length := 0;
        VAR num type := 0;

        at := at + fill(at, received, ROS_HEADER_BYTES + 4);
        check_part;
        IF part_bytes < ROS_HEADER_BYTES + 4 OR (NOT linked) RETURN at;
        UnpackRawBytes part, 1, length \IntX:=DINT;
        UnpackRawBytes part, 5, type \IntX:=DINT;
        at := at + fill(at, received, length + 4);
        IF part_bytes < length + 4 RETURN at;
        part_bytes := 0;
        IF length = ROS_LEN_JOINT_TRAJ_PT AND type = ROS_MSG_JOINT_TRAJ_PT THEN
            UnpackRawBytes part, 9, kind \IntX:=ULINT;
            UnpackRawBytes part, 17, sequence \IntX:=DINT;
            take_point client, part, 1;
        ELSE
            take_other client, part, 1, length;
        ENDIF
        RETURN at;
    ENDFUNC

    ! Move bytes of the chunk from `at` on into `part` until that holds `wanted`; gives how many.
    LOCAL FUNC num fill(num at, num received, num wanted)
        VAR num bytes;

        bytes := wanted - part_bytes;
        IF bytes > received - at + 1 bytes := received - at + 1;
        IF bytes <= 0 RETURN 0;
        CopyRawBytes chunk, at, part, part_bytes + 1 \NoOfBytes:=bytes;
        part_bytes := part_bytes + bytes;
        RETURN bytes;
    ENDFUNC

    ! Where the next message begins is not known any more, so nothing behind it can be trusted.
    LOCAL PROC broken_framing()
        IF receiving THEN
            refuse ROS_REASON_FRAMING, count;
        ELSE
            report ROS_REASON_FRAMING, -1;
        ENDIF
        linked := FALSE;
    ENDPROC

    ! A message that is not a point.
    LOCAL PROC take_other(VAR socketdev client, VAR rawbytes data, num at, num length)
        VAR num type := 0;
        VAR num comm := 0;

        UnpackRawBytes data, at + 4, type \IntX:=DINT;
        UnpackRawBytes data, at + 8, comm \IntX:=DINT;
        IF type = ROS_MSG_JOINT_TRAJ_PT THEN
            ! A point of another size: what else would be wrong?
            broken_framing;
        ELSEIF type = ROS_MSG_PING THEN
            IF comm = ROS_COMM_REQUEST reply client, type, ROS_REPLY_SUCCESS;
        ELSE
            report ROS_REASON_UNKNOWN_MESSAGE, -1;
            IF comm = ROS_COMM_REQUEST reply client, type, ROS_REPLY_FAILURE;
        ENDIF
    ENDPROC

    LOCAL PROC reply(VAR socketdev client, num type, num code)
        ROS_pack_reply answer, type, code;
        IF NOT ROS_send(client, answer) linked := FALSE;
    ENDPROC

    ! The point that begins at byte `at` of `data`; its `kind` and `sequence` are known.
    LOCAL PROC take_point(VAR socketdev client, VAR rawbytes data, num at)
        IF kind = KIND_TOPIC THEN
            requested := FALSE;
        ELSEIF kind = KIND_REQUEST THEN
            requested := TRUE;
        ELSE
            broken_framing;
            RETURN;
        ENDIF
        IF sequence = ROS_SEQ_STOP THEN
            stop_now client;
            RETURN;
        ENDIF
        IF sequence = ROS_SEQ_START_DOWNLOAD begin_trajectory;
        IF skipping THEN
            IF sequence = ROS_SEQ_END skipping := FALSE;
        ELSEIF NOT receiving THEN
            new_trajectory;
            refuse ROS_REASON_NO_START, 0;
        ELSEIF sequence = count OR sequence = ROS_SEQ_END OR count = 0 THEN
            add_point data, at;
            IF receiving AND sequence = ROS_SEQ_END hand_over;
        ELSE
            refuse ROS_REASON_SEQUENCE_GAP, count;
        ENDIF
        IF requested answer_point client;
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
        IF NOT ROS_send(client, answer) linked := FALSE;
    ENDPROC

    ! A new trajectory ends the one under way: where the robot then stands is where the new
    ! one has to begin.
    LOCAL PROC begin_trajectory()
        end_session ROS_REASON_SUPERSEDED;
        new_trajectory;
        ! What modules of different builds would make of it, nobody has tried.
        IF NOT ROS_same_build() refuse ROS_REASON_BUILD_MISMATCH, -1;
    ENDPROC

    LOCAL PROC new_trajectory()
        count := 0;
        receiving := TRUE;
        skipping := FALSE;
        ! The number first and its repetition last: see ROS_common.
        ROS_trajectory := ROS_next(ROS_trajectory);
        ROS_received := 0;
        ROS_refusal := ROS_REASON_NONE;
        ROS_refused_at := -1;
        ROS_phase := ROS_TRAJ_RECEIVING;
        ROS_phase_of := ROS_trajectory;
        point.session := ROS_trajectory;
        point.target := NOWHERE;
        point.stop := FALSE;
        point.dwell := FALSE;
        point.last := FALSE;
    ENDPROC

    ! Check the point at byte `at` of `data` and add it; refuse the trajectory if it is wrong.
    ! Values are accepted for being inside a range, so that one that is no number is refused.
    LOCAL PROC add_point(VAR rawbytes data, num at)
        VAR num joint_1 := 0;
        VAR num joint_2 := 0;
        VAR num joint_3 := 0;
        VAR num joint_4 := 0;
        VAR num joint_5 := 0;
        VAR num joint_6 := 0;
        VAR dnum zeros;

        IF count >= ROS_CAPACITY THEN
            refuse ROS_REASON_CAPACITY, count;
            RETURN;
        ENDIF
        before := point.target;
        UnpackRawBytes data, at + 64, seconds \Float4;
        IF NOT (0 < seconds AND seconds <= LONGEST) check_duration;

        UnpackRawBytes data, at + 20, joint_1 \Float4;
        joint_1 := joint_1 * ROS_DEG;
        IF NOT (ROS_low_1 <= joint_1 AND joint_1 <= ROS_high_1)
            joint_1 := at_limit(joint_1, ROS_low_1, ROS_high_1, 1);
        IF Abs(joint_1 - before.robax.rax_1) > SPEED_1 * seconds
            hurry Abs(joint_1 - before.robax.rax_1) / SPEED_1, 1;

        UnpackRawBytes data, at + 24, joint_2 \Float4;
        joint_2 := joint_2 * ROS_DEG;
        IF NOT (ROS_low_2 <= joint_2 AND joint_2 <= ROS_high_2)
            joint_2 := at_limit(joint_2, ROS_low_2, ROS_high_2, 2);
        IF Abs(joint_2 - before.robax.rax_2) > SPEED_2 * seconds
            hurry Abs(joint_2 - before.robax.rax_2) / SPEED_2, 2;

        UnpackRawBytes data, at + 28, joint_3 \Float4;
        joint_3 := joint_3 * ROS_DEG;
        IF NOT (ROS_low_3 <= joint_3 AND joint_3 <= ROS_high_3)
            joint_3 := at_limit(joint_3, ROS_low_3, ROS_high_3, 3);
        IF Abs(joint_3 - before.robax.rax_3) > SPEED_3 * seconds
            hurry Abs(joint_3 - before.robax.rax_3) / SPEED_3, 3;

        UnpackRawBytes data, at + 32, joint_4 \Float4;
        joint_4 := joint_4 * ROS_DEG;
        IF NOT (ROS_low_4 <= joint_4 AND joint_4 <= ROS_high_4)
            joint_4 := at_limit(joint_4, ROS_low_4, ROS_high_4, 4);
        IF Abs(joint_4 - before.robax.rax_4) > SPEED_4 * seconds
            hurry Abs(joint_4 - before.robax.rax_4) / SPEED_4, 4;

        UnpackRawBytes data, at + 36, joint_5 \Float4;
        joint_5 := joint_5 * ROS_DEG;
        IF NOT (ROS_low_5 <= joint_5 AND joint_5 <= ROS_high_5)
            joint_5 := at_limit(joint_5, ROS_low_5, ROS_high_5, 5);
        IF Abs(joint_5 - before.robax.rax_5) > SPEED_5 * seconds
            hurry Abs(joint_5 - before.robax.rax_5) / SPEED_5, 5;

        UnpackRawBytes data, at + 40, joint_6 \Float4;
        joint_6 := joint_6 * ROS_DEG;
        IF NOT (ROS_low_6 <= joint_6 AND joint_6 <= ROS_high_6)
            joint_6 := at_limit(joint_6, ROS_low_6, ROS_high_6, 6);
        IF Abs(joint_6 - before.robax.rax_6) > SPEED_6 * seconds
            hurry Abs(joint_6 - before.robax.rax_6) / SPEED_6, 6;

        ! Joints that this robot does not have must be zero.
        UnpackRawBytes data, at + 44, zeros \IntX:=ULINT;
        IF zeros <> NO_BITS check_padding data, at;
        UnpackRawBytes data, at + 52, zeros \IntX:=ULINT;
        IF zeros <> NO_BITS check_padding data, at;

        point.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],[9E9,9E9,9E9,9E9,9E9,9E9]];
        IF count > 0 THEN
            IF seconds < SHORTEST AND sequence <> ROS_SEQ_END short_segment;
            ! The same place again: stand there for the duration.
            point.dwell := (point.target = before);
            IF point.dwell points{count}.stop := TRUE;
        ENDIF
        IF NOT receiving RETURN;
        count := count + 1;
        point.index := count;
        point.duration := seconds;
        points{count} := point;
        ROS_received := count;
    ENDPROC

    ! The first point's duration may be zero, no other's; and it must be a number.
    LOCAL PROC check_duration()
        IF seconds = 0 AND count = 0 RETURN;
        refuse not_a_number(seconds, ROS_REASON_BAD_DURATION), count;
    ENDPROC

    ! A joint is outside its limits: the limit, if only by rounding, else the end of it.
    LOCAL FUNC num at_limit(num wanted, num low, num high, num joint)
        IF low - ROUNDING <= wanted AND wanted < low RETURN low;
        IF high < wanted AND wanted <= high + ROUNDING RETURN high;
        refuse 100 * joint + not_a_number(wanted, ROS_REASON_JOINT_LIMIT), count;
        RETURN low;
    ENDFUNC

    ! The reason for refusing a value: `reason`, or that it is none.
    LOCAL FUNC num not_a_number(num wanted, num reason)
        IF -ROS_FINITE <= wanted AND wanted <= ROS_FINITE RETURN reason;
        RETURN ROS_REASON_NOT_FINITE;
    ENDFUNC

    ! Joint `joint` needs `longer` to get here, more than it was given.
    LOCAL PROC hurry(num longer, num joint)
        ! How the robot gets to the first point is not the client's business.
        IF count = 0 RETURN;
        refuse 100 * joint + ROS_REASON_TOO_FAST, count;
    ENDPROC

    LOCAL PROC short_segment()
        refuse ROS_REASON_SEGMENT_TOO_SHORT, count;
    ENDPROC

    LOCAL PROC check_padding(VAR rawbytes data, num at)
        FOR joint FROM 7 TO ROS_MAX_JOINTS DO
            UnpackRawBytes data, at + 16 + 4 * joint, value \Float4;
            IF NOT (value = 0) refuse 100 * joint + ROS_REASON_BAD_PADDING, count;
        ENDFOR
    ENDPROC

    ! The end frame has come and every point was right: hand the trajectory over, if the robot
    ! may move and stands where it begins.
    LOCAL PROC hand_over()
        VAR num obstacle;
        VAR jointtarget here;
        VAR num needed := 0;
        VAR num joint := 0;

        obstacle := what_hinders();
        IF obstacle <> ROS_REASON_NONE THEN
            refuse obstacle, -1;
            RETURN;
        ENDIF
        here := CJointT();
        ! The client's duration for the first point is of no use: it is 10 s when its stamp is
        ! zero, and else the difference to a stamp of the trajectory before.
        reach_start here, points{1}.target, needed, joint;
        IF count = 2 AND points{1}.target = points{2}.target THEN
            ! One point, sent twice: a move from wherever the robot stands, at approach speed
            ! or in the duration given, whichever takes longer.
            IF points{2}.duration > needed needed := points{2}.duration;
            points{2}.duration := 0;
            points{2}.dwell := FALSE;
        ELSEIF joint > 0 THEN
            refuse 100 * joint + ROS_REASON_START_TOO_FAR, 0;
            RETURN;
        ENDIF
        points{1}.duration := needed;
        points{1}.stop := TRUE;
        points{count}.last := TRUE;
        points{count}.stop := TRUE;
        receiving := FALSE;
        fed := 0;
        size := count;
        ! From here on the motion task takes points of this trajectory and no other.
        ROS_phase := ROS_TRAJ_MOVING;
        ROS_session := ROS_trajectory;
        feed;
    ENDPROC

    ! Seconds `needed` to the first point, 0 if it stands there; `joint` is the
    ! first one that is too far from it, 0 if none is.
    LOCAL PROC reach_start(jointtarget here, jointtarget start, VAR num needed, VAR num joint)
        needed := 0;
        joint := 0;
        value := Abs(start.robax.rax_1 - here.robax.rax_1);
        IF value > THERE AND value / (SPEED_1 * APPROACH) > needed
            needed := value / (SPEED_1 * APPROACH);
        IF joint = 0 AND value > NEAR_1 joint := 1;
        value := Abs(start.robax.rax_2 - here.robax.rax_2);
        IF value > THERE AND value / (SPEED_2 * APPROACH) > needed
            needed := value / (SPEED_2 * APPROACH);
        IF joint = 0 AND value > NEAR_2 joint := 2;
        value := Abs(start.robax.rax_3 - here.robax.rax_3);
        IF value > THERE AND value / (SPEED_3 * APPROACH) > needed
            needed := value / (SPEED_3 * APPROACH);
        IF joint = 0 AND value > NEAR_3 joint := 3;
        value := Abs(start.robax.rax_4 - here.robax.rax_4);
        IF value > THERE AND value / (SPEED_4 * APPROACH) > needed
            needed := value / (SPEED_4 * APPROACH);
        IF joint = 0 AND value > NEAR_4 joint := 4;
        value := Abs(start.robax.rax_5 - here.robax.rax_5);
        IF value > THERE AND value / (SPEED_5 * APPROACH) > needed
            needed := value / (SPEED_5 * APPROACH);
        IF joint = 0 AND value > NEAR_5 joint := 5;
        value := Abs(start.robax.rax_6 - here.robax.rax_6);
        IF value > THERE AND value / (SPEED_6 * APPROACH) > needed
            needed := value / (SPEED_6 * APPROACH);
        IF joint = 0 AND value > NEAR_6 joint := 6;
        IF 0 < needed AND needed < SHORTEST needed := SHORTEST;
    ENDPROC

    ! Ask the supervisor whether a trajectory may start. A halt that is still under way is
    ! waited for.
    LOCAL FUNC num what_hinders()
        FOR try FROM 1 TO 30 DO
            ROS_look_asked := ROS_next(ROS_look_asked);
            IF NOT answered() RETURN ROS_REASON_INTERNAL;
            IF ROS_not_ready >= ROS_REASON_NONE RETURN ROS_not_ready;
            WaitTime 0.1;
        ENDFOR
        RETURN ROS_REASON_NOT_EXECUTING;
    ENDFUNC

    ! TRUE when the supervisor has answered all that it was asked, FALSE if it does not.
    LOCAL FUNC bool answered()
        VAR bool late := FALSE;

        WaitUntil ROS_stop_done = ROS_stop_asked AND ROS_look_done = ROS_look_asked
            \MaxTime:=1 \TimeFlag:=late \PollRate:=0.04;
        RETURN NOT late;
    ENDFUNC

    ! Put points into the ring while there is room; announce them when they are written.
    LOCAL PROC feed()
        VAR num head;
        VAR num room;

        head := ROS_head;
        room := ROS_RING_SIZE - 1 - ROS_waiting();
        WHILE room > 0 AND fed < size DO
            fed := fed + 1;
            ROS_ring{head MOD ROS_RING_SIZE + 1} := points{fed};
            head := ROS_next(head);
            room := room - 1;
        ENDWHILE
        ROS_head := head;
        ! The trajectory may have ended while there was no room for the rest of it.
        IF NOT ROS_active() size := fed;
    ENDPROC

    ! STOP: the reply comes when the robot has been told to stop, not when it stands. Points
    ! of this trajectory that are still under way count as sent without a start.
    LOCAL PROC stop_now(VAR socketdev client)
        VAR num code := ROS_REPLY_SUCCESS;

        IF receiving OR ROS_phase = ROS_TRAJ_REFUSED THEN
            receiving := FALSE;
            ROS_refusal := ROS_REASON_STOPPED;
            ROS_phase := ROS_TRAJ_STOPPED;
        ENDIF
        skipping := FALSE;
        end_session ROS_REASON_STOPPED;
        IF NOT answered() code := ROS_REPLY_FAILURE;
        IF requested reply client, ROS_MSG_JOINT_TRAJ_PT, code;
    ENDPROC

    ! Ask for a halt if a trajectory is under way.
    LOCAL PROC end_session(num reason)
        size := fed;
        IF NOT ROS_active() RETURN;
        ROS_stop_reason := reason;
        ROS_stop_asked := ROS_next(ROS_stop_asked);
    ENDPROC

    ! Refuse the whole trajectory that is being received. `code` is reason + 100 x joint,
    ! `index` the point at fault from 0. The first fault counts.
    LOCAL PROC refuse(num code, num index)
        IF NOT receiving RETURN;
        receiving := FALSE;
        skipping := (sequence <> ROS_SEQ_END);
        ROS_refused_at := index;
        ROS_refusal := code;
        ROS_phase := ROS_TRAJ_REFUSED;
        report code, index;
    ENDPROC

    ! One line on the pendant and one in the event log, at most one each a second.
    LOCAL PROC report(num code, num index)
        VAR string place := "";

        IF clock_runs AND seconds_since_line() < 1 THEN
            silent_lines := silent_lines + 1;
            RETURN;
        ENDIF
        IF index >= 0 place := "Point " + ValToStr(index) + ". ";
        IF code >= 100 place := place + "Joint " + ValToStr(code DIV 100) + ". ";
        IF silent_lines > 0 place := place + ValToStr(silent_lines) + " more like it.";
        silent_lines := 0;
        ErrWrite \W, "ROS: trajectory refused", ROS_reason_text(code MOD 100) \RL2:=place;
        TPWrite "ROS refused: " + ROS_reason_text(code MOD 100);
        ClkReset since_line;
        ClkStart since_line;
        clock_runs := TRUE;
    ENDPROC

    LOCAL FUNC num seconds_since_line()
        RETURN ClkRead(since_line);
    ERROR
        ! A clock counts 49 days.
        SkipWarn;
        RETURN ROS_FINITE;
    ENDFUNC
ENDMODULE
