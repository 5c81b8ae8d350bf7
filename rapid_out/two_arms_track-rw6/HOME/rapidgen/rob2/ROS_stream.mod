MODULE ROS_stream
    ! Trajectories of any length, sent in batches of points.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! A point is written into the ring buffer as soon as it was checked; the client sends no more points
    ! than there are free places. The head of the ring buffer is moved once per batch, after its
    ! checksum was verified. At a fault the stream is cut: the accepted points are executed, later ones
    ! are not.

    CONST string ROS_BUILD_STREAM := "5273285319d5";

    ! Duration of the points that must wait in the ring buffer before the robot starts or continues, s.
    LOCAL CONST num PRELOAD := 0.5;
    ! Number of bytes of a point, and of the header of a batch.
    LOCAL CONST num POINT_BYTES := 28;
    LOCAL CONST num HEADER_BYTES := 32;
    ! Values on the wire are integer steps: steps per second, and size of one step of a joint.
    LOCAL CONST dnum STEPS_PER_UNIT := 1000000;
    LOCAL CONST dnum DEG_PER_STEP := 5.729577951308232E-05;

    ! Newest stream: its number given by the client (0: none), its trajectory number, its accepted
    ! points, the code (reason + 100 * joint) that ended it, and the index of the faulty point from 0
    ! (-1: none).
    LOCAL VAR num stream_number := 0;
    LOCAL VAR num trajectory := 0;
    LOCAL VAR num accepted := 0;
    LOCAL VAR num code := 0;
    LOCAL VAR num fault_index := -1;
    ! TRUE if the motion task executes the stream; TRUE if no more points follow.
    LOCAL VAR bool is_started := FALSE;
    LOCAL VAR bool is_ended := FALSE;
    ! TRUE if the stream is a program; TRUE if it starts only after all of it has arrived.
    LOCAL VAR bool is_program := FALSE;
    LOCAL VAR bool is_whole := FALSE;
    ! Head of the ring buffer that includes the points not announced yet, their duration (s), and
    ! whether they wait for more points.
    LOCAL VAR num next_head := 0;
    LOCAL VAR num held_seconds := 0;
    LOCAL VAR bool is_holding := FALSE;

    ! Present batch: the number of its stream, flags, first index and number of points, and the reason
    ! to reject it although it does not belong to the newest stream.
    LOCAL VAR num batch_stream := 0;
    LOCAL VAR num flags := 0;
    LOCAL VAR num batch_first := 0;
    LOCAL VAR num batch_points := 0;
    LOCAL VAR num batch_fault := 0;
    ! Checksum so far, and its value after the header.
    LOCAL VAR dnum checksum := 0;
    LOCAL VAR dnum header_checksum := 0;
    LOCAL VAR bool is_damaged := FALSE;
    LOCAL VAR ROS_progress progress;

    ! Handle the batch that begins at byte `at` of `data`. ROS_pack_batch_reply packs the reply.
    PROC ROS_handle_batch(VAR rawbytes data, num at)
        batch_stream := 0;
        batch_fault := ROS_REASON_NONE;
        IF ROS_frame_length < ROS_LEN_POINTS THEN
            reject_batch ROS_REASON_FRAMING;
        ELSEIF NOT read_header(data, at) THEN
            reject_batch ROS_REASON_CHECKSUM;
        ELSEIF ROS_frame_type = ROS_MSG_POINTS AND POINT_BYTES * batch_points + ROS_LEN_POINTS <> ROS_frame_length THEN
            reject_batch ROS_REASON_FRAMING;
        ELSEIF has_flag(ROS_STREAM_BEGIN) AND ROS_is_active() AND (NOT is_intact(data, at)) THEN
            ! The damaged batch may not really begin a stream, so it must not end the active trajectory.
            reject_batch ROS_REASON_CHECKSUM;
        ELSEIF has_flag(ROS_STREAM_BEGIN) AND batch_stream > 0 THEN
            begin_stream;
            handle_in_sequence data, at;
        ELSEIF batch_stream <> stream_number OR stream_number = 0
            OR is_program <> (ROS_frame_type = ROS_MSG_PROGRAM) THEN
            reject_batch ROS_REASON_NO_START;
        ELSE
            handle_in_sequence data, at;
        ENDIF
    ENDPROC

    ! Pack the reply to the newest batch.
    PROC ROS_pack_batch_reply(VAR rawbytes data)
        IF batch_fault <> ROS_REASON_NONE THEN
            pack_refused data, batch_stream, 0, 0, batch_fault, -1;
            RETURN;
        ENDIF
        check_end;
        IF code <> ROS_REASON_NONE THEN
            pack_refused data, stream_number, trajectory, accepted, code, fault_index;
            RETURN;
        ENDIF
        ROS_read_progress progress;
        ROS_pack_header data, 40, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_SUCCESS \filled;
        PackRawBytes stream_number, data, 17 \IntX:=DINT;
        PackRawBytes trajectory, data, 21 \IntX:=DINT;
        PackRawBytes accepted, data, 25 \IntX:=DINT;
        PackRawBytes free_places(), data, 29 \IntX:=DINT;
        PackRawBytes progress.planned, data, 33 \IntX:=DINT;
        PackRawBytes progress.reached, data, 37 \IntX:=DINT;
        PackRawBytes progress.state, data, 41 \IntX:=DINT;
    ERROR
        RAISE;
    ENDPROC

    ! The client has disconnected. A stream that has not started does not start any more.
    PROC ROS_drop_stream()
        IF stream_number = 0 OR is_started RETURN;
        check_end;
        IF code = ROS_REASON_NONE refuse_stream ROS_REASON_INCOMPLETE, accepted;
    ENDPROC

    LOCAL PROC pack_refused(VAR rawbytes data, num stream_id, num trajectory_id, num accepted_points,
        num reason_code, num point_index)
        ROS_pack_header data, 36, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_FAILURE \filled;
        PackRawBytes stream_id, data, 17 \IntX:=DINT;
        PackRawBytes trajectory_id, data, 21 \IntX:=DINT;
        PackRawBytes accepted_points, data, 25 \IntX:=DINT;
        PackRawBytes reason_code MOD 100, data, 29 \IntX:=DINT;
        PackRawBytes point_index, data, 33 \IntX:=DINT;
        PackRawBytes reason_code DIV 100, data, 37 \IntX:=DINT;
    ERROR
        RAISE;
    ENDPROC

    ! Read the header of the batch. Return FALSE if this fails.
    LOCAL FUNC bool read_header(VAR rawbytes data, num at)
        header_checksum := 0;
        batch_stream := read_header_word(data, at + 16);
        flags := read_header_word(data, at + 20);
        batch_first := read_header_word(data, at + 24);
        batch_points := read_header_word(data, at + 28);
        ! Replace values that no client sends by 0.
        IF batch_stream < 0 OR batch_stream >= ROS_INDEX_WRAP batch_stream := 0;
        IF flags < 0 flags := 0;
        RETURN TRUE;
    ERROR
        SkipWarn;
        batch_stream := 0;
        RETURN FALSE;
    ENDFUNC

    ! Read a word of the header and add it to the checksum.
    LOCAL FUNC num read_header_word(VAR rawbytes data, num at)
        VAR dnum word;

        UnpackRawBytes data, at, word \IntX:=DINT;
        header_checksum := add_to_checksum(header_checksum, word);
        RETURN DnumToNum(word);
    ERROR
        RAISE;
    ENDFUNC

    ! Return the checksum with one more word.
    LOCAL FUNC dnum add_to_checksum(dnum previous_sum, dnum word)
        RETURN (2 * previous_sum + word + ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
    ENDFUNC

    LOCAL FUNC bool has_flag(num flag)
        RETURN (flags DIV flag) MOD 2 = 1;
    ENDFUNC

    ! Return TRUE if the checksum of the batch is correct.
    LOCAL FUNC bool is_intact(VAR rawbytes data, num at)
        VAR dnum word;
        VAR num next_byte;
        VAR num end_byte;

        checksum := header_checksum;
        next_byte := at + HEADER_BYTES;
        end_byte := at + ROS_frame_length;
        WHILE next_byte < end_byte DO
            UnpackRawBytes data, next_byte, word \IntX:=DINT;
            checksum := add_to_checksum(checksum, word);
            next_byte := next_byte + 4;
        ENDWHILE
        UnpackRawBytes data, end_byte, word \IntX:=DINT;
        RETURN word = checksum;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC

    ! Return the number of free places in the ring buffer.
    LOCAL FUNC num free_places()
        VAR num occupied;

        occupied := next_head - ROS_tail_2;
        IF occupied < 0 occupied := occupied + ROS_WRAP;
        RETURN ROS_RING_SIZE - 1 - occupied;
    ENDFUNC

    LOCAL PROC begin_stream()
        stream_number := batch_stream;
        code := ROS_REASON_NONE;
        accepted := 0;
        is_started := FALSE;
        is_ended := FALSE;
        is_program := (ROS_frame_type = ROS_MSG_PROGRAM);
        is_whole := is_program AND has_flag(ROS_STREAM_WHOLE);
        IF is_program ROS_init_program;
        ROS_discard_download;
        ROS_begin_trajectory;
        trajectory := ROS_trajectory_2;
        next_head := ROS_head_2;
    ENDPROC

    ! Reject the present batch. If it belongs to the newest stream, that stream is cut.
    LOCAL PROC reject_batch(num reason)
        IF batch_stream = stream_number AND stream_number > 0 THEN
            check_end;
            IF code = ROS_REASON_NONE cut_stream reason;
        ELSE
            batch_fault := reason;
            ROS_report_refusal reason, -1;
        ENDIF
    ENDPROC

    ! Check whether the trajectory has ended early meanwhile.
    LOCAL PROC check_end()
        IF code <> ROS_REASON_NONE RETURN;
        IF ROS_trajectory_2 <> trajectory THEN
            code := ROS_REASON_SUPERSEDED;
        ELSEIF ROS_phase_2 <> ROS_TRAJ_MOVING THEN
            code := ROS_refusal_code_2;
            fault_index := ROS_refused_point_2;
        ELSEIF ROS_ended_early_2 = trajectory OR ROS_halted_trajectory_2 = trajectory THEN
            ROS_read_progress progress;
            code := progress.code;
            fault_index := progress.index;
        ENDIF
    ENDPROC

    ! Refuse the stream before any of its points was executed.
    LOCAL PROC refuse_stream(num reason, num index)
        code := reason;
        fault_index := index;
        ROS_refuse reason, index;
    ENDPROC

    ! Cut the stream after the accepted points.
    LOCAL PROC cut_stream(num reason)
        IF NOT is_started THEN
            refuse_stream reason, accepted;
            RETURN;
        ENDIF
        code := reason;
        fault_index := accepted;
        ROS_report_refusal reason, fault_index;
        IF NOT is_ended close_stream reason;
    ENDPROC

    ! Close the stream after its last point was written into the ring buffer.
    LOCAL PROC close_stream(num reason)
        publish_head;
        is_ended := TRUE;
        ROS_closed_code_2 := reason;
        ROS_closed_trajectory_2 := trajectory;
    ENDPROC

    LOCAL PROC publish_head()
        ROS_head_2 := next_head;
    ENDPROC

    ! Report a fault of the content only if the batch was transmitted correctly.
    LOCAL PROC cut_stream_if_intact(num reason, VAR rawbytes data, num at)
        IF is_intact(data, at) THEN
            cut_stream reason;
        ELSE
            cut_stream ROS_REASON_CHECKSUM;
        ENDIF
    ENDPROC

    LOCAL PROC handle_in_sequence(VAR rawbytes data, num at)
        VAR num blocker;

        check_end;
        IF code <> ROS_REASON_NONE RETURN;
        IF batch_first <> accepted OR (is_ended AND batch_points > 0) THEN
            cut_stream_if_intact ROS_REASON_SEQUENCE_GAP, data, at;
            RETURN;
        ENDIF
        IF batch_points > 0 AND (NOT is_started) AND (accepted = 0 OR (NOT is_whole)) THEN
            ! This also waits until the ring buffer holds no points of the trajectory that this stream
            ! has ended.
            blocker := ROS_blocker();
            IF blocker <> ROS_REASON_NONE THEN
                refuse_stream blocker, -1;
                RETURN;
            ENDIF
        ENDIF
        IF batch_points > free_places() THEN
            cut_stream_if_intact ROS_REASON_OVERRUN, data, at;
            RETURN;
        ENDIF
        read_points data, at;
        IF code <> ROS_REASON_NONE RETURN;
        IF is_whole AND has_flag(ROS_STREAM_END) AND accepted > 0 AND (NOT is_started) start_program;
        IF code <> ROS_REASON_NONE OR (is_whole AND (NOT has_flag(ROS_STREAM_END))) RETURN;
        IF has_flag(ROS_STREAM_END) AND (NOT is_ended) THEN
            IF NOT is_started THEN
                ! The end flag without any point is an error.
                refuse_stream ROS_REASON_SEQUENCE_GAP, 0;
                RETURN;
            ENDIF
            close_stream ROS_REASON_NONE;
        ELSEIF (NOT is_holding) OR held_seconds >= PRELOAD OR has_flag(ROS_STREAM_FLUSH) THEN
            publish_head;
        ENDIF
    ENDPROC

    ! All of the program has arrived, and every instruction was accepted.
    LOCAL PROC start_program()
        VAR num blocker;

        blocker := ROS_blocker();
        IF blocker = ROS_REASON_NONE blocker := ROS_check_program_start();
        IF blocker = ROS_REASON_NONE THEN
            start_motion;
        ELSE
            refuse_stream blocker, -1;
        ENDIF
    ENDPROC

    LOCAL PROC start_motion()
        is_started := TRUE;
        IF is_program ROS_program_number_2 := trajectory;
        ROS_start_motion;
    ENDPROC

    ! Read the points of the batch. They count only if its checksum is correct.
    LOCAL PROC read_points(VAR rawbytes data, num at)
        VAR num next_byte;
        VAR num remaining;
        VAR dnum received_checksum;
        VAR num head;

        IF next_head = ROS_head_2 THEN
            ! The ring buffer is empty, so the robot stands or will stop.
            is_holding := (ROS_head_2 = ROS_tail_2);
            held_seconds := 0;
        ENDIF
        is_damaged := FALSE;
        checksum := header_checksum;
        head := next_head;
        next_byte := at + HEADER_BYTES;
        remaining := batch_points;
        IF is_program THEN
            ! The duration of instructions is not known in advance, so the program starts without
            ! waiting for more.
            is_holding := FALSE;
            remaining := 0;
            next_byte := at + ROS_frame_length;
            IF batch_points > 0 ROS_read_instructions data, at + HEADER_BYTES, next_byte,
                batch_points, checksum, next_head;
        ENDIF
        IF remaining > 0 THEN
            read_batch data, next_byte, next_byte + POINT_BYTES * remaining;
            next_byte := next_byte + POINT_BYTES * remaining;
        ENDIF
        UnpackRawBytes data, next_byte, received_checksum \IntX:=DINT;
        IF is_damaged OR received_checksum <> checksum THEN
            next_head := head;
            cut_stream ROS_REASON_CHECKSUM;
            RETURN;
        ENDIF
        accepted := ROS_point_count;
        ROS_received_2 := accepted;
        IF accepted > 0 AND (NOT is_started) AND (NOT is_whole) start_motion;
        IF ROS_point_fault <> ROS_REASON_NONE cut_stream ROS_point_fault;
    ERROR
        SkipWarn;
        is_damaged := TRUE;
        TRYNEXT;
    ENDPROC

    ! Check the points from byte `at` of `data` to before `end_byte`. Write each into the ring buffer,
    ! unless it or an earlier one is wrong. This is one routine with a loop, because a routine call for
    ! each point takes time.
    LOCAL PROC read_batch(VAR rawbytes data, num at, num end_byte)
        VAR dnum word_1;
        VAR dnum word_2;
        VAR dnum word_3;
        VAR dnum word_4;
        VAR dnum word_5;
        VAR dnum word_6;
        VAR dnum word_7;
        VAR num joint_1;
        VAR num joint_2;
        VAR num joint_3;
        VAR num joint_4;
        VAR num joint_5;
        VAR num joint_6;

        WHILE at < end_byte AND ROS_point_fault = ROS_REASON_NONE DO
            UnpackRawBytes data, at, word_1 \IntX:=DINT;
            UnpackRawBytes data, at + 4, word_2 \IntX:=DINT;
            UnpackRawBytes data, at + 8, word_3 \IntX:=DINT;
            UnpackRawBytes data, at + 12, word_4 \IntX:=DINT;
            UnpackRawBytes data, at + 16, word_5 \IntX:=DINT;
            UnpackRawBytes data, at + 20, word_6 \IntX:=DINT;
            UnpackRawBytes data, at + 24, word_7 \IntX:=DINT;
            at := at + POINT_BYTES;
            ! This is add_to_checksum for all words at once. The result stays below 2^44, so a dnum
            ! represents it exactly.
            checksum := (128 * checksum
                + 64 * word_1 + 32 * word_2 + 16 * word_3 + 8 * word_4 + 4 * word_5 + 2 * word_6
                + word_7
                + 127 * ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
            ROS_previous := ROS_new_point.target;
            ROS_duration := DnumToNum(word_1 / STEPS_PER_UNIT);
            IF NOT (0 < ROS_duration AND ROS_duration <= ROS_MAX_DURATION) ROS_check_duration;
            joint_1 := DnumToNum(word_2 * DEG_PER_STEP);
            joint_2 := DnumToNum(word_3 * DEG_PER_STEP);
            joint_3 := DnumToNum(word_4 * DEG_PER_STEP);
            joint_4 := DnumToNum(word_5 * DEG_PER_STEP);
            joint_5 := DnumToNum(word_6 * DEG_PER_STEP);
            joint_6 := DnumToNum(word_7 * DEG_PER_STEP);
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
                AND Abs(joint_6 - ROS_previous.robax.rax_6) <= ROS_MAX_SPEED{6} * ROS_duration) THEN
                joint_1 := ROS_check_joint(joint_1, ROS_previous.robax.rax_1, 1);
                joint_2 := ROS_check_joint(joint_2, ROS_previous.robax.rax_2, 2);
                joint_3 := ROS_check_joint(joint_3, ROS_previous.robax.rax_3, 3);
                joint_4 := ROS_check_joint(joint_4, ROS_previous.robax.rax_4, 4);
                joint_5 := ROS_check_joint(joint_5, ROS_previous.robax.rax_5, 5);
                joint_6 := ROS_check_joint(joint_6, ROS_previous.robax.rax_6, 6);
            ENDIF
            ROS_new_point.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],
                [9E9,9E9,9E9,9E9,9E9,9E9]];
            IF ROS_is_first THEN
                check_first_point;
            ELSE
                IF ROS_duration < ROS_MIN_SEGMENT AND (at < end_byte OR (NOT has_flag(ROS_STREAM_END)))
                    ROS_set_fault ROS_REASON_SEGMENT_TOO_SHORT;
                ! A point at the same place again means: stand still for the duration.
                ROS_new_point.dwell := (ROS_new_point.target = ROS_previous);
            ENDIF
            IF ROS_point_fault = ROS_REASON_NONE THEN
                ROS_point_count := (ROS_point_count + 1) MOD ROS_INDEX_WRAP;
                ROS_new_point.index := ROS_point_count;
                ROS_new_point.duration := ROS_duration;
                ROS_ring_2{next_head MOD ROS_RING_SIZE + 1} := ROS_new_point;
                next_head := (next_head + 1) MOD ROS_WRAP;
                held_seconds := held_seconds + ROS_duration;
            ENDIF
        ENDWHILE
        ! The words after a wrong point belong to the checksum only.
        WHILE at < end_byte DO
            UnpackRawBytes data, at, word_1 \IntX:=DINT;
            checksum := add_to_checksum(checksum, word_1);
            at := at + 4;
        ENDWHILE
    ERROR
        SkipWarn;
        is_damaged := TRUE;
        RETURN;
    ENDPROC

    ! The robot must stand near the first point and approaches it by itself. The client's duration for
    ! this point is not used.
    LOCAL PROC check_first_point()
        VAR num joint := 0;

        ROS_check_start CJointT(), ROS_new_point.target, ROS_duration, joint;
        IF joint > 0 ROS_set_fault 100 * joint + ROS_REASON_START_TOO_FAR;
        ROS_is_first := FALSE;
    ENDPROC
ENDMODULE
