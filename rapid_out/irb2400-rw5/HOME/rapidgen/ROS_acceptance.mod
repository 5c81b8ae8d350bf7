MODULE ROS_acceptance
    ! The newest trajectory: its checks, its hand-over, its refusal.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
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

    CONST string ROS_BUILD_ACCEPTANCE := "8a237425283c";

    ! s: longest duration of a point
    CONST num ROS_LONGEST := 3600;
    ! s: shortest duration that the path planner follows through a corner
    CONST num ROS_SHORTEST := 0.1;
    ! Of each joint the speed that a segment may ask for (deg/s, mm/s).
    CONST num ROS_SPEED{6} := [150.15,150.15,150.15,360.36,360.36,450.45];

    ! Fraction of an axis' speed on the way to the first point
    LOCAL CONST num APPROACH := 0.1;
    ! The robot stands at a point if no axis is farther from it than this (deg, mm).
    LOCAL CONST num THERE := 0.01;
    ! A value this near outside a limit is the limit, rounded on its way (deg, mm).
    LOCAL CONST num ROUNDING := 0.0005;
    ! Of each joint how far from the first point the robot may stand (deg, mm).
    LOCAL CONST num NEAR{6} := [0.5,0.5,0.5,0.5,0.5,0.5];
    ! mm/s; deg of all axes together in a piece of a way; what may lie between its pieces.
    LOCAL CONST num TCP_SPEED := 1000;
    LOCAL CONST num PIECE := 20;
    LOCAL CONST num MARGIN := 1.02;
    ! As in the motion task, which has its own.
    TASK PERS tooldata torch := [TRUE,[[0,0,310],[0.92387956,0,0.38268343,0]],[3.4,[0,0,120],[1,0,0,0],0.02,0.02,0.005]];
    TASK PERS wobjdata table := [FALSE,TRUE,"",[[900,0,450],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

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
        RETURN [ROS_program_stops,ROS_control_asked];
    ENDFUNC

    ! What is received from now on came after these stops, whoever sends it.
    PROC ROS_show_stops_seen(ROS_stop_counts stops)
        ROS_stops_seen := stops.program;
        ROS_control_seen := stops.control;
    ENDPROC

    PROC ROS_new_trajectory()
        ROS_first := TRUE;
        ROS_count := 0;
        ROS_fault := ROS_REASON_NONE;
        stops_seen := ROS_stops_before;
        ! The number first and its repetition last: see ROS_common.
        ROS_trajectory := ROS_next(ROS_trajectory);
        IF ROS_program = ROS_trajectory ROS_program := -1;
        ROS_received := 0;
        ROS_refusal := ROS_REASON_NONE;
        ROS_refused_at := -1;
        ROS_phase := ROS_TRAJ_RECEIVING;
        ROS_phase_of := ROS_trajectory;
        ROS_taken.session := ROS_trajectory;
        ROS_taken.dwell := FALSE;
    ENDPROC

    ! From here on the motion task takes points of this trajectory and no other.
    PROC ROS_hand_over()
        ROS_phase := ROS_TRAJ_MOVING;
        ROS_session := ROS_trajectory;
        ! A stop that comes from here on finds it under way; one that came before did not.
        IF ROS_control_asked <> stops_seen.control ROS_end_session ROS_control_reason;
        IF ROS_program_stops <> stops_seen.program THEN
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

    ! The path planner ignores its limit of TCP speed when a move is given its time.
    PROC ROS_check_tcp()
        ROS_taken.least := ROS_least_seconds(ROS_before, ROS_taken.target);
        IF ROS_taken.least <= ROS_seconds RETURN;
        ROS_object ROS_REASON_TCP_TOO_FAST;
    ERROR
        RAISE;
    ENDPROC

    ! Seconds in which the axes, moving together, take the TCP from one place to another without
    ! exceeding its highest speed: the way is no straight line, and not as fast everywhere. It is cut
    ! into pieces; the longest counts, and half of the largest change from one to the next.
    FUNC num ROS_least_seconds(jointtarget start, jointtarget target)
        VAR num turned := 0;
        VAR num pieces;
        VAR jointtarget place;
        VAR robtarget tcp_before;
        VAR robtarget tcp;
        VAR num way;
        VAR num before := -1;
        VAR num longest := 0;
        VAR num change := 0;
        VAR num step_1;
        VAR num step_2;
        VAR num step_3;
        VAR num step_4;
        VAR num step_5;
        VAR num step_6;

        step_1 := target.robax.rax_1 - start.robax.rax_1;
        turned := turned + Abs(step_1);
        step_2 := target.robax.rax_2 - start.robax.rax_2;
        turned := turned + Abs(step_2);
        step_3 := target.robax.rax_3 - start.robax.rax_3;
        turned := turned + Abs(step_3);
        step_4 := target.robax.rax_4 - start.robax.rax_4;
        turned := turned + Abs(step_4);
        step_5 := target.robax.rax_5 - start.robax.rax_5;
        turned := turned + Abs(step_5);
        step_6 := target.robax.rax_6 - start.robax.rax_6;
        turned := turned + Abs(step_6);
        pieces := 2 + Trunc(turned / PIECE);
        step_1 := step_1 / pieces;
        step_2 := step_2 / pieces;
        step_3 := step_3 / pieces;
        step_4 := step_4 / pieces;
        step_5 := step_5 / pieces;
        step_6 := step_6 / pieces;
        place := start;
        tcp_before := CalcRobT(place, torch \WObj:=table);
        FOR piece FROM 1 TO pieces DO
            place.robax.rax_1 := place.robax.rax_1 + step_1;
            place.robax.rax_2 := place.robax.rax_2 + step_2;
            place.robax.rax_3 := place.robax.rax_3 + step_3;
            place.robax.rax_4 := place.robax.rax_4 + step_4;
            place.robax.rax_5 := place.robax.rax_5 + step_5;
            place.robax.rax_6 := place.robax.rax_6 + step_6;
            tcp := CalcRobT(place, torch \WObj:=table);
            way := Distance(tcp_before.trans, tcp.trans);
            IF way > longest longest := way;
            IF before >= 0 AND Abs(way - before) > change change := Abs(way - before);
            before := way;
            tcp_before := tcp;
        ENDFOR
        RETURN MARGIN * (longest + change / 2) * pieces / TCP_SPEED;
    ERROR
        RAISE;
    ENDFUNC

    ! Seconds `needed` to the first point, 0 if it stands there; `joint`,
    ! which has to be 0, becomes the first one that is too far from it.
    PROC ROS_reach_start(jointtarget here, jointtarget start, INOUT num needed, INOUT num joint, INOUT num least)
        needed := 0;
        least := 0;
        reach_start Abs(start.robax.rax_1 - here.robax.rax_1), 1, needed, joint;
        reach_start Abs(start.robax.rax_2 - here.robax.rax_2), 2, needed, joint;
        reach_start Abs(start.robax.rax_3 - here.robax.rax_3), 3, needed, joint;
        reach_start Abs(start.robax.rax_4 - here.robax.rax_4), 4, needed, joint;
        reach_start Abs(start.robax.rax_5 - here.robax.rax_5), 5, needed, joint;
        reach_start Abs(start.robax.rax_6 - here.robax.rax_6), 6, needed, joint;
        IF joint > 0 OR needed = 0 RETURN;
        least := ROS_least_seconds(here, start);
        IF needed < least needed := least;
    ERROR
        RAISE;
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
            IF ROS_control_asked <> stops_seen.control RETURN ROS_control_reason;
            ! So is what forbade motion meanwhile, even if it is over.
            ROS_look_asked := ROS_next(ROS_look_asked);
            IF ROS_unsupervised RETURN ROS_REASON_TASK_ENDED;
            IF NOT ROS_answered(ROS_LATE) THEN
                IF ROS_unsupervised RETURN ROS_REASON_TASK_ENDED;
                RETURN ROS_REASON_INTERNAL;
            ENDIF
            IF ROS_not_ready > ROS_REASON_NONE RETURN ROS_not_ready;
            IF ROS_hindered = ROS_trajectory RETURN ROS_hindrance;
            ! Or if it is over before the supervisor has looked.
            IF ROS_program_stops <> stops_seen.program RETURN ROS_cause(ROS_REASON_PROGRAM_STOPPED);
            IF ROS_not_ready = ROS_REASON_NONE RETURN ROS_REASON_NONE;
            WaitTime 0.1;
        ENDFOR
        RETURN ROS_REASON_NOT_EXECUTING;
    ENDFUNC

    ! TRUE when the supervisor has answered all that it was asked, FALSE if it does not in time.
    FUNC bool ROS_answered(num seconds)
        FOR try FROM 1 TO 250 * seconds DO
            IF ROS_stop_done = ROS_stop_asked AND ROS_look_done = ROS_look_asked RETURN TRUE;
            WaitTime 0.004;
        ENDFOR
        RETURN FALSE;
    ENDFUNC

    ! Ask for a halt if a trajectory is under way.
    PROC ROS_end_session(num reason)
        ROS_to_feed := ROS_fed;
        IF NOT ROS_active() RETURN;
        ROS_stop_reason := reason;
        ROS_stop_asked := ROS_next(ROS_stop_asked);
    ENDPROC

    ! Wait for the halt that was asked for. Without an answer this task stops the robot, and asks
    ! again: the supervisor may have just answered what came before.
    PROC ROS_await_halt()
        IF ROS_answered(ROS_SOON) RETURN;
        IF ROS_stopped_alone() ROS_stop_asked := ROS_next(ROS_stop_asked);
    ENDPROC

    ! STOP: what has not begun to move never will, and a refusal is no fault any more.
    PROC ROS_forget_trajectory()
        IF ROS_phase <> ROS_TRAJ_RECEIVING AND ROS_phase <> ROS_TRAJ_REFUSED RETURN;
        ROS_refusal := ROS_REASON_STOPPED;
        ROS_phase := ROS_TRAJ_STOPPED;
    ENDPROC

    ! Refuse the whole trajectory. `code` is reason + 100 x joint, `index` the point at fault
    ! from 0, -1: none.
    PROC ROS_refuse(num code, num index)
        ROS_refused_at := index;
        ROS_refusal := code;
        ROS_phase := ROS_TRAJ_REFUSED;
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
