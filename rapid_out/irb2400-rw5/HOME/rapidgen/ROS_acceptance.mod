MODULE ROS_acceptance
    ! Acceptance of the newest trajectory: its checks, its start and its refusal.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! This module is shared by trajectories that are sent as a whole (ROS_download) and in batches
    ! (ROS_stream). The caller unpacks a point, lets this module check it, and then reads
    ! ROS_point_fault.

    ! Counts of stops and starts of the
    ! program, and of stops that the control server asked for.
    RECORD ROS_stop_counts
        num program;
        num control;
        ! The same without stops for a lost client.
        num commands;
    ENDRECORD

    CONST string ROS_BUILD_ACCEPTANCE := "e6da4508cd5b";

    ! Longest duration of a point, s.
    CONST num ROS_MAX_DURATION := 3600;
    ! Shortest duration that the path planner follows through a corner, s (`min_segment`).
    CONST num ROS_MIN_SEGMENT := 0.1;
    ! Highest speed of each joint in a segment, deg/s or mm/s.
    CONST num ROS_MAX_SPEED{6} := [150.15,150.15,150.15,360.36,360.36,450.45];

    ! Fraction of each axis' highest speed that is used to approach the first point.
    LOCAL CONST num APPROACH_FACTOR := 0.1;
    ! The robot stands at a point if no axis is farther away than this, deg or mm.
    LOCAL CONST num AT_TARGET_TOL := 0.01;
    ! A value that exceeds a limit by no more than this was rounded on its way and is replaced by the
    ! limit, deg or mm.
    LOCAL CONST num ROUNDING_TOL := 0.0005;
    ! Largest distance of each joint from the first point when the trajectory starts, deg or mm.
    LOCAL CONST num START_TOL{6} := [0.5,0.5,0.5,0.5,0.5,0.5];
    ! Highest TCP speed, mm/s; turn of all axes together in one piece of a way, deg; factor for the
    ! speed within a piece, which is not computed.
    LOCAL CONST num MAX_TCP_SPEED := 1000;
    LOCAL CONST num PIECE_DEG := 20;
    LOCAL CONST num TCP_SPEED_MARGIN := 1.02;
    ! These data are copies of this task. The motion task has its own.
    TASK PERS tooldata torch := [TRUE,[[0,0,310],[0.92387956,0,0.38268343,0]],[3.4,[0,0,120],[1,0,0,0],0.02,0.02,0.005]];
    TASK PERS wobjdata table := [FALSE,TRUE,"",[[900,0,450],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

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
    ! At most one warning per second is written. The others are counted.
    LOCAL VAR clock clock_report;
    LOCAL VAR num unreported := 0;
    LOCAL VAR bool clock_running := FALSE;

    ! A new trajectory ends the active one. The new one must begin where the robot then stands.
    PROC ROS_begin_trajectory()
        ROS_end_trajectory ROS_REASON_SUPERSEDED;
        ROS_new_trajectory;
        ! Tasks with modules of different builds may interpret a trajectory differently.
        IF ROS_get_build_fault() = ROS_REASON_BUILD_MISMATCH ROS_refuse ROS_REASON_BUILD_MISMATCH, -1;
    ENDPROC

    ! Return the present counts of stops.
    FUNC ROS_stop_counts ROS_current_stops()
        RETURN [ROS_program_stops,ROS_control_asked,ROS_control_commands];
    ENDFUNC

    ! Publish that everything that is received from now on, from any client, is newer than these stops.
    PROC ROS_publish_stops_seen(ROS_stop_counts stops)
        ROS_program_stops_seen := stops.program;
        ROS_control_stops_seen := stops.control;
    ENDPROC

    PROC ROS_new_trajectory()
        ROS_is_first := TRUE;
        ROS_point_count := 0;
        ROS_point_fault := ROS_REASON_NONE;
        stops_at_start := ROS_stops_before;
        is_replacement := ROS_is_replacing;
        ! Write the number first and repeat it last (see ROS_trajectory in ROS_common).
        ROS_trajectory := ROS_next_count(ROS_trajectory);
        IF ROS_program_number = ROS_trajectory ROS_program_number := -1;
        ROS_received := 0;
        ROS_refusal_code := ROS_REASON_NONE;
        ROS_refused_point := -1;
        ROS_phase := ROS_TRAJ_RECEIVING;
        ROS_phase_trajectory := ROS_trajectory;
        ROS_new_point.trajectory := ROS_trajectory;
        ROS_new_point.dwell := FALSE;
    ENDPROC

    ! Return TRUE if the control server has asked for a stop since the first byte of the trajectory arrived.
    LOCAL FUNC bool is_stopped_by_control()
        IF is_replacement RETURN ROS_control_commands <> stops_at_start.commands;
        RETURN ROS_control_asked <> stops_at_start.control;
    ENDFUNC

    ! From now on the motion task executes the points of this trajectory and of no other.
    PROC ROS_start_motion()
        ROS_phase := ROS_TRAJ_MOVING;
        ROS_active_trajectory := ROS_trajectory;
        ! A later stop finds the trajectory active and halts it. A stop that came before this is handled
        ! here.
        IF is_stopped_by_control() ROS_end_trajectory ROS_control_reason;
        IF ROS_program_stops <> stops_at_start.program THEN
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

    ! Check the TCP speed here, because the path planner ignores its limit when a move has a programmed
    ! time.
    PROC ROS_check_tcp()
        ROS_new_point.min_duration := ROS_min_tcp_duration(ROS_previous, ROS_new_point.target);
        IF ROS_new_point.min_duration <= ROS_duration RETURN;
        ROS_set_fault ROS_REASON_TCP_TOO_FAST;
    ERROR
        RAISE;
    ENDPROC

    ! Return the shortest time (s) in which the axes, moving together, take the TCP from `start` to
    ! `target` without exceeding its highest speed. The way is not a straight line, and the speed varies
    ! along it. Therefore it is cut into pieces: the longest piece counts, plus half of the largest
    ! change between two pieces.
    FUNC num ROS_min_tcp_duration(jointtarget start, jointtarget target)
        VAR num total_turn := 0;
        VAR num pieces;
        VAR jointtarget joints;
        VAR robtarget previous_tcp;
        VAR robtarget tcp;
        VAR num travel;
        VAR num previous := -1;
        VAR num max_travel := 0;
        VAR num max_change := 0;
        VAR num step_1;
        VAR num step_2;
        VAR num step_3;
        VAR num step_4;
        VAR num step_5;
        VAR num step_6;

        step_1 := target.robax.rax_1 - start.robax.rax_1;
        total_turn := total_turn + Abs(step_1);
        step_2 := target.robax.rax_2 - start.robax.rax_2;
        total_turn := total_turn + Abs(step_2);
        step_3 := target.robax.rax_3 - start.robax.rax_3;
        total_turn := total_turn + Abs(step_3);
        step_4 := target.robax.rax_4 - start.robax.rax_4;
        total_turn := total_turn + Abs(step_4);
        step_5 := target.robax.rax_5 - start.robax.rax_5;
        total_turn := total_turn + Abs(step_5);
        step_6 := target.robax.rax_6 - start.robax.rax_6;
        total_turn := total_turn + Abs(step_6);
        pieces := 2 + Trunc(total_turn / PIECE_DEG);
        step_1 := step_1 / pieces;
        step_2 := step_2 / pieces;
        step_3 := step_3 / pieces;
        step_4 := step_4 / pieces;
        step_5 := step_5 / pieces;
        step_6 := step_6 / pieces;
        joints := start;
        previous_tcp := CalcRobT(joints, torch \WObj:=table);
        FOR piece FROM 1 TO pieces DO
            joints.robax.rax_1 := joints.robax.rax_1 + step_1;
            joints.robax.rax_2 := joints.robax.rax_2 + step_2;
            joints.robax.rax_3 := joints.robax.rax_3 + step_3;
            joints.robax.rax_4 := joints.robax.rax_4 + step_4;
            joints.robax.rax_5 := joints.robax.rax_5 + step_5;
            joints.robax.rax_6 := joints.robax.rax_6 + step_6;
            tcp := CalcRobT(joints, torch \WObj:=table);
            travel := Distance(previous_tcp.trans, tcp.trans);
            IF travel > max_travel max_travel := travel;
            IF previous >= 0 AND Abs(travel - previous) > max_change max_change := Abs(travel - previous);
            previous := travel;
            previous_tcp := tcp;
        ENDFOR
        RETURN TCP_SPEED_MARGIN * (max_travel + max_change / 2) * pieces / MAX_TCP_SPEED;
    ERROR
        RAISE;
    ENDFUNC

    ! Compute the time to the first point (`approach_time`, s), 0 if the robot stands there. `joint`
    ! must be 0; it becomes the first joint that is too far from the first point.
    PROC ROS_check_start(jointtarget current, jointtarget start, INOUT num approach_time,
        INOUT num joint, INOUT num min_duration)
        approach_time := 0;
        min_duration := 0;
        check_start_axis Abs(start.robax.rax_1 - current.robax.rax_1), 1, approach_time, joint;
        check_start_axis Abs(start.robax.rax_2 - current.robax.rax_2), 2, approach_time, joint;
        check_start_axis Abs(start.robax.rax_3 - current.robax.rax_3), 3, approach_time, joint;
        check_start_axis Abs(start.robax.rax_4 - current.robax.rax_4), 4, approach_time, joint;
        check_start_axis Abs(start.robax.rax_5 - current.robax.rax_5), 5, approach_time, joint;
        check_start_axis Abs(start.robax.rax_6 - current.robax.rax_6), 6, approach_time, joint;
        IF joint > 0 OR approach_time = 0 RETURN;
        min_duration := ROS_min_tcp_duration(current, start);
        IF approach_time < min_duration approach_time := min_duration;
    ERROR
        RAISE;
    ENDPROC

    LOCAL PROC check_start_axis(num travel, num n, INOUT num approach_time, INOUT num joint)
        IF joint = 0 AND travel > START_TOL{n} joint := n;
        IF travel <= AT_TARGET_TOL RETURN;
        IF approach_time < ROS_MIN_SEGMENT approach_time := ROS_MIN_SEGMENT;
        IF approach_time < travel / (ROS_MAX_SPEED{n} * APPROACH_FACTOR)
            approach_time := travel / (ROS_MAX_SPEED{n} * APPROACH_FACTOR);
    ENDPROC

    ! Ask the supervisor whether the trajectory may start, and wait for a halt in progress (3 s at
    ! most). Return 0 or the reason against a start.
    FUNC num ROS_blocker()
        FOR try FROM 1 TO 30 DO
            ! A stop after the first byte of the trajectory also applies to this trajectory.
            IF is_stopped_by_control() RETURN ROS_control_reason;
            ! The supervisor waits until such a stop is known to be older than what may move the robot.
            IF is_replacement ROS_control_stops_seen := ROS_control_asked;
            ! The same holds for a condition that has forbidden motion meanwhile, even if it is over.
            ROS_check_asked := ROS_next_count(ROS_check_asked);
            IF ROS_supervisor_missing RETURN ROS_REASON_TASK_ENDED;
            IF NOT ROS_wait_answered(ROS_REPLY_TIMEOUT) THEN
                IF ROS_supervisor_missing RETURN ROS_REASON_TASK_ENDED;
                RETURN ROS_REASON_INTERNAL;
            ENDIF
            IF ROS_not_ready > ROS_REASON_NONE RETURN ROS_not_ready;
            IF ROS_blocked = ROS_trajectory RETURN ROS_blocker_code;
            ! The same holds for a stop that was over before the supervisor could notice it.
            IF ROS_program_stops <> stops_at_start.program RETURN ROS_stop_cause(ROS_REASON_PROGRAM_STOPPED);
            IF ROS_not_ready = ROS_REASON_NONE RETURN ROS_REASON_NONE;
            WaitTime 0.1;
        ENDFOR
        RETURN ROS_REASON_NOT_EXECUTING;
    ENDFUNC

    ! Wait until the supervisor has answered all requests. Return FALSE if this takes longer than
    ! `seconds`.
    FUNC bool ROS_wait_answered(num seconds)
        FOR try FROM 1 TO 250 * seconds DO
            IF ROS_stop_done = ROS_stop_asked AND ROS_check_done = ROS_check_asked RETURN TRUE;
            WaitTime 0.004;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    ! Request a halt if a trajectory is active.
    PROC ROS_end_trajectory(num reason)
        ROS_feed_total := ROS_feed_count;
        IF NOT ROS_is_active() RETURN;
        ROS_stop_reason := reason;
        ROS_stop_asked := ROS_next_count(ROS_stop_asked);
    ENDPROC

    ! Wait for the requested halt. Without an answer this task stops the robot and repeats the request,
    ! because the supervisor may have answered just an earlier one.
    PROC ROS_wait_halted()
        IF ROS_wait_answered(ROS_STOP_TIMEOUT) RETURN;
        IF ROS_fallback_stop() ROS_stop_asked := ROS_next_count(ROS_stop_asked);
    ENDPROC

    ! STOP discards a trajectory that has not started, and also resets the error of a refused one.
    PROC ROS_discard_trajectory()
        IF ROS_phase <> ROS_TRAJ_RECEIVING AND ROS_phase <> ROS_TRAJ_REFUSED RETURN;
        ROS_refusal_code := ROS_REASON_STOPPED;
        ROS_phase := ROS_TRAJ_STOPPED;
    ENDPROC

    ! Refuse the whole trajectory. `code` is reason + 100 * joint; `index` is the faulty point from 0,
    ! or -1.
    PROC ROS_refuse(num code, num index)
        ROS_refused_point := index;
        ROS_refusal_code := code;
        ROS_phase := ROS_TRAJ_REFUSED;
        ROS_report_refusal code, index;
    ENDPROC

    ! Write at most one warning per second to the event log. Nothing is written on the pendant, because
    ! that may delay this task, which also receives STOP.
    PROC ROS_report_refusal(num code, num index)
        VAR string text := "";

        IF clock_running AND ROS_elapsed_seconds(clock_report) < 1 THEN
            unreported := unreported + 1;
            RETURN;
        ENDIF
        IF index >= 0 text := "Point " + ValToStr(index) + ". ";
        IF code DIV 100 > 0 text := text + "Joint " + ValToStr(code DIV 100) + ". ";
        IF unreported > 0 text := text + ValToStr(unreported) + " more like it.";
        unreported := 0;
        ErrWrite \W, "ROS: trajectory refused", ROS_reason_text(code MOD 100) \RL2:=text;
        ROS_start_clock clock_report;
        clock_running := TRUE;
    ENDPROC
ENDMODULE
