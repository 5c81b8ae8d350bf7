MODULE ROS_download
    ! Trajectories that come whole: points -1, 1, 2, ..., -3.
    !
    ! Robot "two_arms_track-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! Each point is checked when it comes; nothing is handed over before -3 has come and
    ! everything was right. Then the points go through the ring to the motion task.

    CONST string ROS_BUILD_DOWNLOAD := "88e807c4be29";

    ! A trajectory is being received, and still may become one.
    VAR bool ROS_receiving := FALSE;

    LOCAL VAR ROS_point points{ROS_CAPACITY};
    ! What is left of a refused or stopped trajectory is not looked at.
    LOCAL VAR bool skipping := FALSE;

    ! The point number `sequence` that begins at byte `at` of `data`, whatever it is.
    PROC ROS_take_point(VAR rawbytes data, num at, num sequence)
        IF sequence = ROS_SEQ_START_DOWNLOAD begin_download;
        IF skipping THEN
            IF sequence = ROS_SEQ_END skipping := FALSE;
        ELSEIF NOT ROS_receiving THEN
            ROS_new_trajectory;
            ROS_refuse_download ROS_REASON_NO_START, 0, sequence = ROS_SEQ_END;
        ELSEIF sequence = ROS_count OR sequence = ROS_SEQ_END OR ROS_count = 0 THEN
            ROS_add_point data, at, sequence;
            IF ROS_receiving AND sequence = ROS_SEQ_END hand_over;
        ELSE
            ROS_refuse_download ROS_REASON_SEQUENCE_GAP, ROS_count, FALSE;
        ENDIF
    ERROR
        RAISE;
    ENDPROC

    ! Check the point at byte `at` of `data` and add it; refuse the trajectory if it is wrong.
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

        IF ROS_count >= ROS_CAPACITY THEN
            ROS_refuse_download ROS_REASON_CAPACITY, ROS_count, sequence = ROS_SEQ_END;
            RETURN;
        ENDIF
        ROS_before := ROS_taken.target;
        UnpackRawBytes data, at + 64, ROS_seconds \Float4;
        IF NOT (0 < ROS_seconds AND ROS_seconds <= ROS_LONGEST) ROS_check_duration;

        UnpackRawBytes data, at + 20, joint_1 \Float4;
        joint_1 := joint_1 * ROS_DEG;
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1}
            AND Abs(joint_1 - ROS_before.robax.rax_1) <= ROS_SPEED{1} * ROS_seconds)
            joint_1 := ROS_judged(joint_1, ROS_before.robax.rax_1, 1);

        UnpackRawBytes data, at + 24, joint_2 \Float4;
        joint_2 := joint_2 * ROS_DEG;
        IF NOT (ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2}
            AND Abs(joint_2 - ROS_before.robax.rax_2) <= ROS_SPEED{2} * ROS_seconds)
            joint_2 := ROS_judged(joint_2, ROS_before.robax.rax_2, 2);

        UnpackRawBytes data, at + 28, joint_3 \Float4;
        joint_3 := joint_3 * ROS_DEG;
        IF NOT (ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3}
            AND Abs(joint_3 - ROS_before.robax.rax_3) <= ROS_SPEED{3} * ROS_seconds)
            joint_3 := ROS_judged(joint_3, ROS_before.robax.rax_3, 3);

        UnpackRawBytes data, at + 32, joint_4 \Float4;
        joint_4 := joint_4 * ROS_DEG;
        IF NOT (ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4}
            AND Abs(joint_4 - ROS_before.robax.rax_4) <= ROS_SPEED{4} * ROS_seconds)
            joint_4 := ROS_judged(joint_4, ROS_before.robax.rax_4, 4);

        UnpackRawBytes data, at + 36, joint_5 \Float4;
        joint_5 := joint_5 * ROS_DEG;
        IF NOT (ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5}
            AND Abs(joint_5 - ROS_before.robax.rax_5) <= ROS_SPEED{5} * ROS_seconds)
            joint_5 := ROS_judged(joint_5, ROS_before.robax.rax_5, 5);

        UnpackRawBytes data, at + 40, joint_6 \Float4;
        joint_6 := joint_6 * ROS_DEG;
        IF NOT (ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6}
            AND Abs(joint_6 - ROS_before.robax.rax_6) <= ROS_SPEED{6} * ROS_seconds)
            joint_6 := ROS_judged(joint_6, ROS_before.robax.rax_6, 6);

        UnpackRawBytes data, at + 44, joint_7 \Float4;
        joint_7 := joint_7 * ROS_MM;
        IF NOT (ROS_low{7} <= joint_7 AND joint_7 <= ROS_high{7}
            AND Abs(joint_7 - ROS_before.extax.eax_a) <= ROS_SPEED{7} * ROS_seconds)
            joint_7 := ROS_judged(joint_7, ROS_before.extax.eax_a, 7);

        UnpackRawBytes data, at + 48, joint_8 \Float4;
        joint_8 := joint_8 * ROS_DEG;
        IF NOT (ROS_low{8} <= joint_8 AND joint_8 <= ROS_high{8}
            AND Abs(joint_8 - ROS_before.extax.eax_b) <= ROS_SPEED{8} * ROS_seconds)
            joint_8 := ROS_judged(joint_8, ROS_before.extax.eax_b, 8);

        ! Joints that this robot does not have must be zero.
        FOR joint FROM 9 TO ROS_MAX_JOINTS DO
            UnpackRawBytes data, at + 16 + 4 * joint, padding \Float4;
            IF NOT (padding = 0) ROS_object 100 * joint + ROS_REASON_BAD_PADDING;
        ENDFOR

        ROS_taken.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],[joint_7,joint_8,9E9,9E9,9E9,9E9]];
        IF ROS_first THEN
            ROS_first := FALSE;
        ELSE
            IF ROS_seconds < ROS_SHORTEST AND sequence <> ROS_SEQ_END
                ROS_object ROS_REASON_SEGMENT_TOO_SHORT;
            ! The same place again: stand there for the duration.
            ROS_taken.dwell := (ROS_taken.target = ROS_before);
        ENDIF
        IF ROS_fault <> ROS_REASON_NONE THEN
            ROS_refuse_download ROS_fault, ROS_count, sequence = ROS_SEQ_END;
            RETURN;
        ENDIF
        ROS_count := ROS_count + 1;
        ROS_taken.index := ROS_count;
        ROS_taken.duration := ROS_seconds;
        points{ROS_count} := ROS_taken;
        ROS_received_1 := ROS_count;
    ERROR
        RAISE;
    ENDPROC

    ! Put points into the ring while there is room; announce them when they are written. Behind
    ! the last one the trajectory is closed.
    PROC ROS_feed()
        VAR num head;
        VAR num room;

        head := ROS_head_1;
        room := ROS_RING_SIZE - 1 - ROS_waiting();
        WHILE room > 0 AND ROS_fed < ROS_to_feed DO
            ROS_fed := ROS_fed + 1;
            ROS_ring_1{head MOD ROS_RING_SIZE + 1} := points{ROS_fed};
            head := ROS_next(head);
            room := room - 1;
        ENDWHILE
        ROS_head_1 := head;
        IF NOT ROS_active() THEN
            ! The trajectory has ended while there was no room for the rest of it.
            ROS_to_feed := ROS_fed;
        ELSEIF ROS_fed = ROS_to_feed THEN
            ROS_closed_code_1 := ROS_REASON_NONE;
            ROS_closed_1 := ROS_session_1;
        ENDIF
    ENDPROC

    ! The client has said STOP: what it has sent without an end frame is no trajectory.
    PROC ROS_forget_download()
        ROS_receiving := FALSE;
        skipping := FALSE;
    ENDPROC

    ! The client is gone.
    PROC ROS_lose_download()
        IF ROS_receiving ROS_refuse_download ROS_REASON_INCOMPLETE, ROS_count, TRUE;
        skipping := FALSE;
    ENDPROC

    ! Refuse the whole trajectory that is being received; unless this was the end of it, skip
    ! what follows.
    PROC ROS_refuse_download(num code, num index, bool ended)
        ROS_receiving := FALSE;
        skipping := NOT ended;
        ROS_refuse code, index;
    ENDPROC

    LOCAL PROC begin_download()
        ROS_begin_trajectory;
        ROS_receiving := (ROS_phase_1 = ROS_TRAJ_RECEIVING);
        skipping := NOT ROS_receiving;
    ENDPROC

    ! The end frame has come and every point was right: hand the trajectory over, if the robot
    ! may move and stands where it begins.
    LOCAL PROC hand_over()
        VAR num obstacle;
        VAR jointtarget here;
        VAR num needed := 0;
        VAR num joint := 0;

        obstacle := ROS_what_hinders();
        IF obstacle <> ROS_REASON_NONE THEN
            ROS_refuse_download obstacle, -1, TRUE;
            RETURN;
        ENDIF
        here := CJointT();
        ! The client's duration for the first point is of no use: it is 10 s when its stamp is
        ! zero, and else the difference to a stamp of the trajectory before.
        ROS_reach_start here, points{1}.target, needed, joint;
        IF joint > 0 THEN
            ROS_refuse_download 100 * joint + ROS_REASON_START_TOO_FAR, 0, TRUE;
            RETURN;
        ENDIF
        IF ROS_count = 2 AND points{2}.dwell THEN
            ! One point, sent twice: a place to go to, not one to stay at; in the duration given, if
            ! that is longer.
            IF points{2}.duration > needed needed := points{2}.duration;
            points{2}.duration := 0;
        ENDIF
        points{1}.duration := needed;
        ROS_receiving := FALSE;
        ROS_fed := 0;
        ROS_to_feed := ROS_count;
        ROS_hand_over;
    ENDPROC
ENDMODULE
