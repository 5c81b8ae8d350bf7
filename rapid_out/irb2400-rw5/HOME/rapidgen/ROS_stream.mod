MODULE ROS_stream
    ! Trajectories without end, in batches of points.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! A point goes into the ring as soon as it is checked: its client has been told that there is
    ! room. The head of the ring is moved once a batch, when its checksum is right. Behind a fault
    ! the stream is cut: what was accepted before is executed, and nothing that follows.

    CONST string ROS_BUILD_STREAM := "8a237425283c";

    ! s of points that wait in the ring before the robot begins to move, or moves on.
    LOCAL CONST num PRELOAD := 0.5;
    ! Bytes of a point, and in front of the first one of a batch.
    LOCAL CONST num POINT_BYTES := 28;
    LOCAL CONST num HEAD_BYTES := 32;
    ! Numbers of the wire are steps: so many to a second, and what one is of a joint.
    LOCAL CONST dnum STEPS := 1000000;
    LOCAL CONST dnum DEG := 5.729577951308232E-05;

    ! The client's number of the newest stream (0: none), its trajectory, its points that were
    ! accepted, why nothing of it is taken any more (reason + 100 x joint), and the point at
    ! fault from 0 (-1: none).
    LOCAL VAR num stream := 0;
    LOCAL VAR num trajectory := 0;
    LOCAL VAR num accepted := 0;
    LOCAL VAR num code := 0;
    LOCAL VAR num place := -1;
    ! It was handed to the motion task; no point of it follows.
    LOCAL VAR bool handed_over := FALSE;
    LOCAL VAR bool ended := FALSE;
    ! It is a program, of which nothing is executed before all of it has come.
    LOCAL VAR bool is_program := FALSE;
    LOCAL VAR bool whole := FALSE;
    ! The head of the ring, as soon as the points that were not announced yet are; how many
    ! seconds these are, and whether they wait for more of them.
    LOCAL VAR num written := 0;
    LOCAL VAR num held := 0;
    LOCAL VAR bool holding := FALSE;

    ! The batch at hand, and why it was refused although it is not of the newest stream.
    LOCAL VAR num number := 0;
    LOCAL VAR num flags := 0;
    LOCAL VAR num first := 0;
    LOCAL VAR num points := 0;
    LOCAL VAR num strange := 0;
    ! Its checksum so far, and what that was behind the head.
    LOCAL VAR dnum check := 0;
    LOCAL VAR dnum check_of_head := 0;
    LOCAL VAR bool damaged := FALSE;
    LOCAL VAR ROS_progress told;

    ! Take the batch that begins at byte `at` of `data`. ROS_pack_batch_reply has the answer.
    PROC ROS_take_batch(VAR rawbytes data, num at)
        number := 0;
        strange := ROS_REASON_NONE;
        IF ROS_frame_length < ROS_LEN_POINTS THEN
            reject ROS_REASON_FRAMING;
        ELSEIF NOT has_head(data, at) THEN
            reject ROS_REASON_CHECKSUM;
        ELSEIF ROS_frame_type = ROS_MSG_POINTS AND POINT_BYTES * points + ROS_LEN_POINTS <> ROS_frame_length THEN
            reject ROS_REASON_FRAMING;
        ELSEIF has(ROS_STREAM_BEGIN) AND ROS_active() AND (NOT is_intact(data, at)) THEN
            ! Not even that it begins something is sure: what is under way must not end for it.
            reject ROS_REASON_CHECKSUM;
        ELSEIF has(ROS_STREAM_BEGIN) AND number > 0 THEN
            begin_stream;
            take_if_in_order data, at;
        ELSEIF number <> stream OR stream = 0 OR is_program <> (ROS_frame_type = ROS_MSG_PROGRAM) THEN
            reject ROS_REASON_NO_START;
        ELSE
            take_if_in_order data, at;
        ENDIF
    ENDPROC

    ! The answer to the batch that was taken last.
    PROC ROS_pack_batch_reply(VAR rawbytes data)
        IF strange <> ROS_REASON_NONE THEN
            pack_refused data, number, 0, 0, strange, -1;
            RETURN;
        ENDIF
        see_end;
        IF code <> ROS_REASON_NONE THEN
            pack_refused data, stream, trajectory, accepted, code, place;
            RETURN;
        ENDIF
        ROS_look told;
        ROS_pack_header data, 40, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_SUCCESS;
        PackRawBytes stream, data, 17 \IntX:=DINT;
        PackRawBytes trajectory, data, 21 \IntX:=DINT;
        PackRawBytes accepted, data, 25 \IntX:=DINT;
        PackRawBytes room(), data, 29 \IntX:=DINT;
        PackRawBytes told.planned, data, 33 \IntX:=DINT;
        PackRawBytes told.reached, data, 37 \IntX:=DINT;
        PackRawBytes told.state, data, 41 \IntX:=DINT;
    ERROR
        RAISE;
    ENDPROC

    ! The client is gone: a stream that has not begun to move never will.
    PROC ROS_lose_stream()
        IF stream = 0 OR handed_over RETURN;
        see_end;
        IF code = ROS_REASON_NONE refuse ROS_REASON_INCOMPLETE, accepted;
    ENDPROC

    LOCAL PROC pack_refused(VAR rawbytes data, num whose, num its, num taken, num why, num point)
        ROS_pack_header data, 36, ROS_frame_type, ROS_COMM_REPLY, ROS_REPLY_FAILURE;
        PackRawBytes whose, data, 17 \IntX:=DINT;
        PackRawBytes its, data, 21 \IntX:=DINT;
        PackRawBytes taken, data, 25 \IntX:=DINT;
        PackRawBytes why MOD 100, data, 29 \IntX:=DINT;
        PackRawBytes point, data, 33 \IntX:=DINT;
        PackRawBytes why DIV 100, data, 37 \IntX:=DINT;
    ERROR
        RAISE;
    ENDPROC

    ! Read the head of the batch. FALSE if that fails.
    LOCAL FUNC bool has_head(VAR rawbytes data, num at)
        check_of_head := 0;
        number := read_number(data, at + 16);
        flags := read_number(data, at + 20);
        first := read_number(data, at + 24);
        points := read_number(data, at + 28);
        ! What nobody sends is none, so that all of them count from 0.
        IF number < 0 OR number >= ROS_INDEX_WRAP number := 0;
        IF flags < 0 flags := 0;
        RETURN TRUE;
    ERROR
        SkipWarn;
        number := 0;
        RETURN FALSE;
    ENDFUNC

    ! A number of the head, which enters its checksum.
    LOCAL FUNC num read_number(VAR rawbytes data, num at)
        VAR dnum word;

        UnpackRawBytes data, at, word \IntX:=DINT;
        check_of_head := with_word(check_of_head, word);
        RETURN DnumToNum(word);
    ERROR
        RAISE;
    ENDFUNC

    ! The checksum with one more word.
    LOCAL FUNC dnum with_word(dnum before, dnum word)
        RETURN (2 * before + word + ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
    ENDFUNC

    LOCAL FUNC bool has(num bit)
        RETURN (flags DIV bit) MOD 2 = 1;
    ENDFUNC

    ! TRUE if the checksum of the batch is right.
    LOCAL FUNC bool is_intact(VAR rawbytes data, num at)
        VAR dnum word;
        VAR num here;
        VAR num behind;

        check := check_of_head;
        here := at + HEAD_BYTES;
        behind := at + ROS_frame_length;
        WHILE here < behind DO
            UnpackRawBytes data, here, word \IntX:=DINT;
            check := with_word(check, word);
            here := here + 4;
        ENDWHILE
        UnpackRawBytes data, behind, word \IntX:=DINT;
        RETURN word = check;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC

    ! Places in the ring that are free.
    LOCAL FUNC num room()
        VAR num waiting;

        waiting := written - ROS_tail;
        IF waiting < 0 waiting := waiting + ROS_WRAP;
        RETURN ROS_RING_SIZE - 1 - waiting;
    ENDFUNC

    LOCAL PROC begin_stream()
        stream := number;
        code := ROS_REASON_NONE;
        accepted := 0;
        handed_over := FALSE;
        ended := FALSE;
        is_program := (ROS_frame_type = ROS_MSG_PROGRAM);
        whole := is_program AND has(ROS_STREAM_WHOLE);
        IF is_program ROS_begin_program;
        ROS_forget_download;
        ROS_begin_trajectory;
        trajectory := ROS_trajectory;
        written := ROS_head;
    ENDPROC

    ! Refuse the batch at hand: if it is of the newest stream that is cut, else it is nobody's.
    LOCAL PROC reject(num reason)
        IF number = stream AND stream > 0 THEN
            see_end;
            IF code = ROS_REASON_NONE cut reason;
        ELSE
            strange := reason;
            ROS_report reason, -1;
        ENDIF
    ENDPROC

    ! See whether the trajectory has ended early meanwhile, for whatever reason.
    LOCAL PROC see_end()
        IF code <> ROS_REASON_NONE RETURN;
        IF ROS_trajectory <> trajectory THEN
            code := ROS_REASON_SUPERSEDED;
        ELSEIF ROS_phase <> ROS_TRAJ_MOVING THEN
            code := ROS_refusal;
            place := ROS_refused_at;
        ELSEIF ROS_dead = trajectory OR ROS_halted = trajectory THEN
            ROS_look told;
            code := told.code;
            place := told.index;
        ENDIF
    ENDPROC

    ! Nothing of the trajectory moves.
    LOCAL PROC refuse(num reason, num index)
        code := reason;
        place := index;
        ROS_refuse reason, index;
    ENDPROC

    ! Nothing behind the points that were accepted is executed.
    LOCAL PROC cut(num reason)
        IF NOT handed_over THEN
            refuse reason, accepted;
            RETURN;
        ENDIF
        code := reason;
        place := accepted;
        ROS_report reason, place;
        IF NOT ended close_stream reason;
    ENDPROC

    ! The last point is in the ring.
    LOCAL PROC close_stream(num reason)
        announce;
        ended := TRUE;
        ROS_closed_code := reason;
        ROS_closed := trajectory;
    ENDPROC

    LOCAL PROC announce()
        ROS_head := written;
    ENDPROC

    ! What a batch says is its fault only if it came as it was sent.
    LOCAL PROC cut_if_intact(num reason, VAR rawbytes data, num at)
        IF is_intact(data, at) THEN
            cut reason;
        ELSE
            cut ROS_REASON_CHECKSUM;
        ENDIF
    ENDPROC

    LOCAL PROC take_if_in_order(VAR rawbytes data, num at)
        VAR num obstacle;

        see_end;
        IF code <> ROS_REASON_NONE RETURN;
        IF first <> accepted OR (ended AND points > 0) THEN
            cut_if_intact ROS_REASON_SEQUENCE_GAP, data, at;
            RETURN;
        ENDIF
        IF points > 0 AND (NOT handed_over) AND (accepted = 0 OR (NOT whole)) THEN
            ! This also waits until nothing is left in the ring of what this stream has ended.
            obstacle := ROS_what_hinders();
            IF obstacle <> ROS_REASON_NONE THEN
                refuse obstacle, -1;
                RETURN;
            ENDIF
        ENDIF
        IF points > room() THEN
            cut_if_intact ROS_REASON_OVERRUN, data, at;
            RETURN;
        ENDIF
        take_points data, at;
        IF code <> ROS_REASON_NONE RETURN;
        IF whole AND has(ROS_STREAM_END) AND accepted > 0 AND (NOT handed_over) begin_whole;
        IF code <> ROS_REASON_NONE OR (whole AND (NOT has(ROS_STREAM_END))) RETURN;
        IF has(ROS_STREAM_END) AND (NOT ended) THEN
            IF NOT handed_over THEN
                ! An end without a beginning.
                refuse ROS_REASON_SEQUENCE_GAP, 0;
                RETURN;
            ENDIF
            close_stream ROS_REASON_NONE;
        ELSEIF (NOT holding) OR held >= PRELOAD OR has(ROS_STREAM_FLUSH) THEN
            announce;
        ENDIF
    ENDPROC

    ! All of a program is here, and every instruction was right.
    LOCAL PROC begin_whole()
        VAR num obstacle;

        obstacle := ROS_what_hinders();
        IF obstacle = ROS_REASON_NONE obstacle := ROS_start_fault();
        IF obstacle = ROS_REASON_NONE THEN
            begin_motion;
        ELSE
            refuse obstacle, -1;
        ENDIF
    ENDPROC

    LOCAL PROC begin_motion()
        handed_over := TRUE;
        IF is_program ROS_program := trajectory;
        ROS_hand_over;
    ENDPROC

    ! Take the points of the batch. They count if its checksum is right.
    LOCAL PROC take_points(VAR rawbytes data, num at)
        VAR num here;
        VAR num left;
        VAR dnum sum;
        VAR num head;

        IF written = ROS_head THEN
            ! Nothing waits in the ring: the robot stands, or will.
            holding := (ROS_head = ROS_tail);
            held := 0;
        ENDIF
        damaged := FALSE;
        check := check_of_head;
        head := written;
        here := at + HEAD_BYTES;
        left := points;
        IF is_program THEN
            ! Nobody can say how long a robot takes for instructions: it begins with what is there.
            holding := FALSE;
            left := 0;
            here := at + ROS_frame_length;
            IF points > 0 ROS_take_instructions data, at + HEAD_BYTES, here, points, check, written;
        ENDIF
        WHILE left > 0 DO
            left := left - 1;
            take_point data, here, left = 0 AND has(ROS_STREAM_END);
            here := here + POINT_BYTES;
        ENDWHILE
        UnpackRawBytes data, here, sum \IntX:=DINT;
        IF damaged OR sum <> check THEN
            written := head;
            cut ROS_REASON_CHECKSUM;
            RETURN;
        ENDIF
        accepted := ROS_count;
        ROS_received := accepted;
        IF accepted > 0 AND (NOT handed_over) AND (NOT whole) begin_motion;
        IF ROS_fault <> ROS_REASON_NONE cut ROS_fault;
    ERROR
        SkipWarn;
        damaged := TRUE;
        TRYNEXT;
    ENDPROC

    ! Check the point at byte `at` of `data`, and write it into the ring unless it or one before
    ! it is wrong.
    LOCAL PROC take_point(VAR rawbytes data, num at, bool last)
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

        UnpackRawBytes data, at, word_1 \IntX:=DINT;
        UnpackRawBytes data, at + 4, word_2 \IntX:=DINT;
        UnpackRawBytes data, at + 8, word_3 \IntX:=DINT;
        UnpackRawBytes data, at + 12, word_4 \IntX:=DINT;
        UnpackRawBytes data, at + 16, word_5 \IntX:=DINT;
        UnpackRawBytes data, at + 20, word_6 \IntX:=DINT;
        UnpackRawBytes data, at + 24, word_7 \IntX:=DINT;
        ! As with_word, one after the other: what comes of it stays below 2^44.
        check := (128 * check
            + 64 * word_1 + 32 * word_2 + 16 * word_3 + 8 * word_4 + 4 * word_5 + 2 * word_6
            + word_7
            + 127 * ROS_CHECKSUM_OFFSET) MOD ROS_CHECKSUM_MODULUS;
        IF ROS_fault <> ROS_REASON_NONE RETURN;
        ROS_before := ROS_taken.target;
        ROS_seconds := DnumToNum(word_1 / STEPS);
        IF NOT (0 < ROS_seconds AND ROS_seconds <= ROS_LONGEST) ROS_check_duration;
        joint_1 := DnumToNum(word_2 * DEG);
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1}
            AND Abs(joint_1 - ROS_before.robax.rax_1) <= ROS_SPEED{1} * ROS_seconds)
            joint_1 := ROS_judged(joint_1, ROS_before.robax.rax_1, 1);
        joint_2 := DnumToNum(word_3 * DEG);
        IF NOT (ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2}
            AND Abs(joint_2 - ROS_before.robax.rax_2) <= ROS_SPEED{2} * ROS_seconds)
            joint_2 := ROS_judged(joint_2, ROS_before.robax.rax_2, 2);
        joint_3 := DnumToNum(word_4 * DEG);
        IF NOT (ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3}
            AND Abs(joint_3 - ROS_before.robax.rax_3) <= ROS_SPEED{3} * ROS_seconds)
            joint_3 := ROS_judged(joint_3, ROS_before.robax.rax_3, 3);
        joint_4 := DnumToNum(word_5 * DEG);
        IF NOT (ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4}
            AND Abs(joint_4 - ROS_before.robax.rax_4) <= ROS_SPEED{4} * ROS_seconds)
            joint_4 := ROS_judged(joint_4, ROS_before.robax.rax_4, 4);
        joint_5 := DnumToNum(word_6 * DEG);
        IF NOT (ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5}
            AND Abs(joint_5 - ROS_before.robax.rax_5) <= ROS_SPEED{5} * ROS_seconds)
            joint_5 := ROS_judged(joint_5, ROS_before.robax.rax_5, 5);
        joint_6 := DnumToNum(word_7 * DEG);
        IF NOT (ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6}
            AND Abs(joint_6 - ROS_before.robax.rax_6) <= ROS_SPEED{6} * ROS_seconds)
            joint_6 := ROS_judged(joint_6, ROS_before.robax.rax_6, 6);
        ROS_taken.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],[9E9,9E9,9E9,9E9,9E9,9E9]];
        IF ROS_first THEN
            begin_at_first;
        ELSE
            IF ROS_seconds < ROS_SHORTEST AND (NOT last)
                ROS_object ROS_REASON_SEGMENT_TOO_SHORT;
            ! The same place again: stand there for the duration.
            ROS_taken.dwell := (ROS_taken.target = ROS_before);
            IF ROS_fault = ROS_REASON_NONE ROS_check_tcp;
        ENDIF
        IF ROS_fault <> ROS_REASON_NONE RETURN;
        ROS_count := ROS_count + 1;
        IF ROS_count = ROS_INDEX_WRAP ROS_count := 0;
        ROS_taken.index := ROS_count;
        ROS_taken.duration := ROS_seconds;
        ROS_ring{written MOD ROS_RING_SIZE + 1} := ROS_taken;
        written := written + 1;
        IF written = ROS_WRAP written := 0;
        held := held + ROS_seconds;
    ERROR
        SkipWarn;
        damaged := TRUE;
        RETURN;
    ENDPROC

    ! The first point: the robot has to stand where it is, and goes there by itself. The client's
    ! duration for it is of no use.
    LOCAL PROC begin_at_first()
        VAR num joint := 0;

        ROS_reach_start CJointT(), ROS_taken.target, ROS_seconds, joint, ROS_taken.least;
        IF joint > 0 ROS_object 100 * joint + ROS_REASON_START_TOO_FAR;
        ROS_first := FALSE;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
