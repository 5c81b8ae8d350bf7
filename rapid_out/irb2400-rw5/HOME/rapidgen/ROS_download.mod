MODULE ROS_download
    ! Trajectories that are sent as a whole: points -1, 1, 2, ..., -3.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! Each point is checked when it arrives. The trajectory starts only after -3 has arrived and all
    ! points were accepted. The points then go through the ring buffer to the motion task.

    CONST string ROS_BUILD_DOWNLOAD := "e6da4508cd5b";

    ! TRUE while a trajectory is being received that was not refused.
    VAR bool ROS_receiving := FALSE;

    LOCAL VAR ROS_point points{ROS_CAPACITY};
    ! TRUE while the remaining points of a refused or stopped trajectory are skipped.
    LOCAL VAR bool skipping := FALSE;

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
        IF NOT (ROS_low{1} <= joint_1 AND joint_1 <= ROS_high{1}
            AND Abs(joint_1 - ROS_previous.robax.rax_1) <= ROS_MAX_SPEED{1} * ROS_duration)
            joint_1 := ROS_check_joint(joint_1, ROS_previous.robax.rax_1, 1);

        UnpackRawBytes data, at + 24, joint_2 \Float4;
        joint_2 := joint_2 * ROS_DEG;
        IF NOT (ROS_low{2} <= joint_2 AND joint_2 <= ROS_high{2}
            AND Abs(joint_2 - ROS_previous.robax.rax_2) <= ROS_MAX_SPEED{2} * ROS_duration)
            joint_2 := ROS_check_joint(joint_2, ROS_previous.robax.rax_2, 2);

        UnpackRawBytes data, at + 28, joint_3 \Float4;
        joint_3 := joint_3 * ROS_DEG;
        IF NOT (ROS_low{3} <= joint_3 AND joint_3 <= ROS_high{3}
            AND Abs(joint_3 - ROS_previous.robax.rax_3) <= ROS_MAX_SPEED{3} * ROS_duration)
            joint_3 := ROS_check_joint(joint_3, ROS_previous.robax.rax_3, 3);

        UnpackRawBytes data, at + 32, joint_4 \Float4;
        joint_4 := joint_4 * ROS_DEG;
        IF NOT (ROS_low{4} <= joint_4 AND joint_4 <= ROS_high{4}
            AND Abs(joint_4 - ROS_previous.robax.rax_4) <= ROS_MAX_SPEED{4} * ROS_duration)
            joint_4 := ROS_check_joint(joint_4, ROS_previous.robax.rax_4, 4);

        UnpackRawBytes data, at + 36, joint_5 \Float4;
        joint_5 := joint_5 * ROS_DEG;
        IF NOT (ROS_low{5} <= joint_5 AND joint_5 <= ROS_high{5}
            AND Abs(joint_5 - ROS_previous.robax.rax_5) <= ROS_MAX_SPEED{5} * ROS_duration)
            joint_5 := ROS_check_joint(joint_5, ROS_previous.robax.rax_5, 5);

        UnpackRawBytes data, at + 40, joint_6 \Float4;
        joint_6 := joint_6 * ROS_DEG;
        IF NOT (ROS_low{6} <= joint_6 AND joint_6 <= ROS_high{6}
            AND Abs(joint_6 - ROS_previous.robax.rax_6) <= ROS_MAX_SPEED{6} * ROS_duration)
            joint_6 := ROS_check_joint(joint_6, ROS_previous.robax.rax_6, 6);

        ! Joints that this robot does not have must be zero.
        FOR joint FROM 7 TO ROS_MAX_JOINTS DO
            UnpackRawBytes data, at + 16 + 4 * joint, padding \Float4;
            IF NOT (padding = 0) ROS_set_fault 100 * joint + ROS_REASON_BAD_PADDING;
        ENDFOR

        ROS_new_point.target := [[joint_1,joint_2,joint_3,joint_4,joint_5,joint_6],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
        IF ROS_is_first THEN
            ROS_is_first := FALSE;
        ELSE
            IF ROS_duration < ROS_MIN_SEGMENT AND sequence <> ROS_SEQ_END
                ROS_set_fault ROS_REASON_SEGMENT_TOO_SHORT;
            ! A point at the same place again means: stand still for the duration.
            ROS_new_point.dwell := (ROS_new_point.target = ROS_previous);
            IF ROS_point_fault = ROS_REASON_NONE ROS_check_tcp;
        ENDIF
        IF ROS_point_fault <> ROS_REASON_NONE THEN
            ROS_refuse_download ROS_point_fault, ROS_point_count, sequence = ROS_SEQ_END;
            RETURN;
        ENDIF
        ROS_point_count := ROS_point_count + 1;
        ROS_new_point.index := ROS_point_count;
        ROS_new_point.duration := ROS_duration;
        points{ROS_point_count} := ROS_new_point;
        ROS_received := ROS_point_count;
    ERROR
        RAISE;
    ENDPROC

    ! Write points into the ring buffer while there are free places, and announce them afterwards. Close
    ! the trajectory after its last point.
    PROC ROS_feed_ring()
        VAR num head;
        VAR num free_places;

        head := ROS_head;
        free_places := ROS_RING_SIZE - 1 - ROS_ring_count();
        WHILE free_places > 0 AND ROS_feed_count < ROS_feed_total DO
            ROS_feed_count := ROS_feed_count + 1;
            ROS_ring{head MOD ROS_RING_SIZE + 1} := points{ROS_feed_count};
            head := ROS_next_count(head);
            free_places := free_places - 1;
        ENDWHILE
        ROS_head := head;
        IF NOT ROS_is_active() THEN
            ! The trajectory has ended before all of its points were in the ring buffer.
            ROS_feed_total := ROS_feed_count;
        ELSEIF ROS_feed_count = ROS_feed_total THEN
            ROS_closed_code := ROS_REASON_NONE;
            ROS_closed_trajectory := ROS_active_trajectory;
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
        ROS_receiving := (ROS_phase = ROS_TRAJ_RECEIVING);
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
        ROS_check_start current, points{1}.target, approach_time, joint, points{1}.min_duration;
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
