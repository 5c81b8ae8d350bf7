MODULE ROS_acceptance
    ! The newest trajectory: its checks, its hand-over, its refusal.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! What a trajectory that comes whole and one that comes in batches have in common. The one
    ! who takes a point unpacks it, lets it be checked here, and looks at ROS_fault then.

    ! Stops and starts of the program, and stops that the control server asked for.
    RECORD ROS_stop_counts
        num program;
        num control;
    ENDRECORD

    CONST string ROS_BUILD_ACCEPTANCE := "88e807c4be29";

    ! s: longest duration of a point
    CONST num ROS_LONGEST := 3600;
    ! s: shortest duration that the path planner follows through a corner
    CONST num ROS_SHORTEST := 0.1;
    ! Of each joint the speed that a segment may ask for (deg/s, mm/s).
    CONST num ROS_SPEED{6} := [250.25,250.25,250.25,320.32,320.32,420.42];

    ! Fraction of an axis' speed on the way to the first point
    LOCAL CONST num APPROACH := 0.1;
    ! The robot stands at a point if no axis is farther from it than this (deg, mm).
    LOCAL CONST num THERE := 0.01;
    ! A value this near outside a limit is the limit, rounded on its way (deg, mm).
    LOCAL CONST num ROUNDING := 0.0005;
    ! Of each joint how far from the first point the robot may stand (deg, mm).
    LOCAL CONST num NEAR{6} := [0.5,0.5,0.5,0.5,0.5,0.5];

    ! The point at hand, its duration, and the place of the one before.
    VAR ROS_point ROS_taken;
    VAR num ROS_seconds := 0;
    VAR jointtarget ROS_before;
    ! The point at hand is the first.
    VAR bool ROS_first := TRUE;
    ! Points of the trajectory that were accepted, and what is wrong with the one at hand: the
    ! first fault counts (reason + 100 x joint).
    VAR num ROS_count := 0;
    VAR num ROS_fault := 0;
    ! Points of a trajectory that was handed over whole, and how many of them are in the ring.
    VAR num ROS_to_feed := 0;
    VAR num ROS_fed := 0;

    ! Stops that came before all that is being taken, ...
    VAR ROS_stop_counts ROS_stops_before;
    ! ... and before the first point of the trajectory.
    LOCAL VAR ROS_stop_counts stops_seen;
    ! Warnings are rationed.
    LOCAL VAR clock since_line;
    LOCAL VAR num silent_lines := 0;
    LOCAL VAR bool clock_runs := FALSE;

    ! A new trajectory ends the one under way: where the robot then stands is where the new one
    ! has to begin.
    PROC ROS_begin_trajectory()
        ROS_end_session ROS_REASON_SUPERSEDED;
        ROS_new_trajectory;
        ! What modules of different builds would make of it, nobody has tried.
        IF ROS_build_fault() = ROS_REASON_BUILD_MISMATCH ROS_refuse ROS_REASON_BUILD_MISMATCH, -1;
    ENDPROC

    ! Stops so far.
    FUNC ROS_stop_counts ROS_stops_now()
        RETURN [ROS_program_stops_2,ROS_control_asked_2];
    ENDFUNC

    ! What is received from now on came after these stops, whoever sends it.
    PROC ROS_show_stops_seen(ROS_stop_counts stops)
        ROS_stops_seen_2 := stops.program;
        ROS_control_seen_2 := stops.control;
    ENDPROC

    PROC ROS_new_trajectory()
        ROS_first := TRUE;
        ROS_count := 0;
        ROS_fault := ROS_REASON_NONE;
        stops_seen := ROS_stops_before;
        ! The number first and its repetition last: see ROS_common.
        ROS_trajectory_2 := ROS_next(ROS_trajectory_2);
        IF ROS_program_2 = ROS_trajectory_2 ROS_program_2 := -1;
        ROS_received_2 := 0;
        ROS_refusal_2 := ROS_REASON_NONE;
        ROS_refused_at_2 := -1;
        ROS_phase_2 := ROS_TRAJ_RECEIVING;
        ROS_phase_of_2 := ROS_trajectory_2;
        ROS_taken.session := ROS_trajectory_2;
        ROS_taken.dwell := FALSE;
    ENDPROC

    ! From here on the motion task takes points of this trajectory and no other.
    PROC ROS_hand_over()
        ROS_phase_2 := ROS_TRAJ_MOVING;
        ROS_session_2 := ROS_trajectory_2;
        ! A stop that comes from here on finds it under way; one that came before did not.
        IF ROS_control_asked_2 <> stops_seen.control ROS_end_session ROS_control_reason_2;
        IF ROS_program_stops_2 <> stops_seen.program THEN
            ROS_end_session ROS_cause(ROS_REASON_PROGRAM_STOPPED);
            ! Its points are announced only when the robot has been stopped.
            ROS_await_halt;
        ENDIF
    ENDPROC

    ! -- checks of a point: values are accepted for being inside a range, so that one that is no
    ! number is refused ---------------------------------------------------------------------------

    PROC ROS_object(num code)
        IF ROS_fault = ROS_REASON_NONE ROS_fault := code;
    ENDPROC

    ! The first point's duration may be zero, no other's; and it must be a number.
    PROC ROS_check_duration()
        IF ROS_seconds = 0 AND ROS_first RETURN;
        ROS_object not_a_number(ROS_seconds, ROS_REASON_BAD_DURATION);
        ! What is computed with it below must fit a num.
        ROS_seconds := ROS_LONGEST;
    ENDPROC

    ! A joint is outside its limits, or faster than its axis. Gives what is taken in its place:
    ! the limit, if it is outside only by rounding.
    FUNC num ROS_judged(num wanted, num before, num joint)
        VAR num lowest;
        VAR num highest;
        VAR num taken;

        lowest := ROS_low{joint};
        highest := ROS_high{joint};
        taken := wanted;
        IF lowest - ROUNDING <= wanted AND wanted < lowest taken := lowest;
        IF highest < wanted AND wanted <= highest + ROUNDING taken := highest;
        IF NOT (lowest <= taken AND taken <= highest)
            ROS_object 100 * joint + not_a_number(wanted, ROS_REASON_JOINT_LIMIT);
        ! How the robot gets to the first point is not the client's business.
        IF ROS_first OR Abs(taken - before) <= ROS_SPEED{joint} * ROS_seconds RETURN taken;
        ROS_object 100 * joint + ROS_REASON_TOO_FAST;
        RETURN taken;
    ENDFUNC

    ! The reason for refusing a value: `reason`, or that it is none.
    LOCAL FUNC num not_a_number(num wanted, num reason)
        IF -ROS_FINITE <= wanted AND wanted <= ROS_FINITE RETURN reason;
        RETURN ROS_REASON_NOT_FINITE;
    ENDFUNC

    ! Seconds `needed` to the first point, 0 if it stands there; `joint`,
    ! which has to be 0, becomes the first one that is too far from it.
    PROC ROS_reach_start(jointtarget here, jointtarget start, INOUT num needed, INOUT num joint)
        needed := 0;
        reach_start Abs(start.robax.rax_1 - here.robax.rax_1), 1, needed, joint;
        reach_start Abs(start.robax.rax_2 - here.robax.rax_2), 2, needed, joint;
        reach_start Abs(start.robax.rax_3 - here.robax.rax_3), 3, needed, joint;
        reach_start Abs(start.robax.rax_4 - here.robax.rax_4), 4, needed, joint;
        reach_start Abs(start.robax.rax_5 - here.robax.rax_5), 5, needed, joint;
        reach_start Abs(start.robax.rax_6 - here.robax.rax_6), 6, needed, joint;
    ENDPROC

    LOCAL PROC reach_start(num way, num n, INOUT num needed, INOUT num joint)
        IF joint = 0 AND way > NEAR{n} joint := n;
        IF way <= THERE RETURN;
        IF needed < ROS_SHORTEST needed := ROS_SHORTEST;
        IF needed < way / (ROS_SPEED{n} * APPROACH) needed := way / (ROS_SPEED{n} * APPROACH);
    ENDPROC

    ! Ask the supervisor whether the trajectory may start. A halt that is still under way is
    ! waited for.
    FUNC num ROS_what_hinders()
        FOR try FROM 1 TO 30 DO
            ! A stop that came behind its first byte is for this trajectory, too.
            IF ROS_control_asked_2 <> stops_seen.control RETURN ROS_control_reason_2;
            ! So is what forbade motion meanwhile, even if it is over.
            ROS_look_asked_2 := ROS_next(ROS_look_asked_2);
            IF ROS_unsupervised RETURN ROS_REASON_TASK_ENDED;
            IF NOT ROS_answered(ROS_LATE) THEN
                IF ROS_unsupervised RETURN ROS_REASON_TASK_ENDED;
                RETURN ROS_REASON_INTERNAL;
            ENDIF
            IF ROS_not_ready_2 > ROS_REASON_NONE RETURN ROS_not_ready_2;
            IF ROS_hindered_2 = ROS_trajectory_2 RETURN ROS_hindrance_2;
            ! Or if it is over before the supervisor has looked.
            IF ROS_program_stops_2 <> stops_seen.program RETURN ROS_cause(ROS_REASON_PROGRAM_STOPPED);
            IF ROS_not_ready_2 = ROS_REASON_NONE RETURN ROS_REASON_NONE;
            WaitTime 0.1;
        ENDFOR
        RETURN ROS_REASON_NOT_EXECUTING;
    ENDFUNC

    ! TRUE when the supervisor has answered all that it was asked, FALSE if it does not in time.
    FUNC bool ROS_answered(num seconds)
        FOR try FROM 1 TO 250 * seconds DO
            IF ROS_stop_done_2 = ROS_stop_asked_2 AND ROS_look_done_2 = ROS_look_asked_2 RETURN TRUE;
            WaitTime 0.004;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    ! Ask for a halt if a trajectory is under way.
    PROC ROS_end_session(num reason)
        ROS_to_feed := ROS_fed;
        IF NOT ROS_active() RETURN;
        ROS_stop_reason_2 := reason;
        ROS_stop_asked_2 := ROS_next(ROS_stop_asked_2);
    ENDPROC

    ! Wait for the halt that was asked for. Without an answer this task stops the robot, and asks
    ! again: the supervisor may have just answered what came before.
    PROC ROS_await_halt()
        IF ROS_answered(ROS_SOON) RETURN;
        IF ROS_stopped_alone() ROS_stop_asked_2 := ROS_next(ROS_stop_asked_2);
    ENDPROC

    ! STOP: what has not begun to move never will, and a refusal is no fault any more.
    PROC ROS_forget_trajectory()
        IF ROS_phase_2 <> ROS_TRAJ_RECEIVING AND ROS_phase_2 <> ROS_TRAJ_REFUSED RETURN;
        ROS_refusal_2 := ROS_REASON_STOPPED;
        ROS_phase_2 := ROS_TRAJ_STOPPED;
    ENDPROC

    ! Refuse the whole trajectory. `code` is reason + 100 x joint, `index` the point at fault
    ! from 0, -1: none.
    PROC ROS_refuse(num code, num index)
        ROS_refused_at_2 := index;
        ROS_refusal_2 := code;
        ROS_phase_2 := ROS_TRAJ_REFUSED;
        ROS_report code, index;
    ENDPROC

    ! One warning in the event log a second, at most. No line on the pendant: one that comes at a bad
    ! moment holds up its task, and this one reads STOP.
    PROC ROS_report(num code, num index)
        VAR string place := "";

        IF clock_runs AND ROS_elapsed(since_line) < 1 THEN
            silent_lines := silent_lines + 1;
            RETURN;
        ENDIF
        IF index >= 0 place := "Point " + ValToStr(index) + ". ";
        IF code DIV 100 > 0 place := place + "Joint " + ValToStr(code DIV 100) + ". ";
        IF silent_lines > 0 place := place + ValToStr(silent_lines) + " more like it.";
        silent_lines := 0;
        ErrWrite \W, "ROS: trajectory refused", ROS_reason_text(code MOD 100) \RL2:=place;
        ROS_start_clock since_line;
        clock_runs := TRUE;
    ENDPROC
ENDMODULE
