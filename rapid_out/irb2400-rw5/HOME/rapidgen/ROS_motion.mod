MODULE ROS_motion
    ! The motion task: the only one that moves.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! It takes points out of the ring and gives them to the path planner, nothing else: every
    ! check was made before a point was put in. A point whose successor is there is passed
    ! through its zone; without one it is a stop point, so the planner never runs dry in a corner.

    CONST string ROS_BUILD_MOTION := "8a237425283c";

    ! With \T in the move the speed is only formal.
    LOCAL CONST speeddata SPEED := [1000,500,1000,1000];
    LOCAL CONST zonedata CORNER := z5;
    ! What an axis does of its acceleration without doubt (deg/s^2, mm/s^2).
    LOCAL CONST num TURN_1 := 150;
    LOCAL CONST num TURN_2 := 150;
    LOCAL CONST num TURN_3 := 150;
    LOCAL CONST num TURN_4 := 360;
    LOCAL CONST num TURN_5 := 360;
    LOCAL CONST num TURN_6 := 450;
    ! A corner is as small as the axes follow without slowing down, and CORNER at most: it may take
    ! that, lasts this long at least (s), and is not smaller than this (mm, deg).
    LOCAL CONST num SHORTEST_CORNER := 0.025;
    LOCAL CONST num SMALLEST_CORNER := 0.3;
    LOCAL CONST num SMALLEST_TURN := 0.03;
    ! mm/s of a TCP that moves no more than its place is known.
    LOCAL CONST num RESTING := 0.1;
    ! TASK: another group may have one of the same name.
    TASK PERS tooldata torch := [TRUE,[[0,0,310],[0.92387956,0,0.38268343,0]],[3.4,[0,0,120],[1,0,0,0],0.02,0.02,0.005]];
    TASK PERS wobjdata table := [FALSE,TRUE,"",[[900,0,450],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

    ! s in which an acceleration is there and gone again.
    LOCAL CONST num BUILD_UP := 0.1;
    ! Part of the highest TCP speed with which the point at hand is left behind.
    LOCAL VAR num left_at := 0;

    ! The corner at it: TCP speed on its faster side (mm/s), time that the axes need to turn there (s).
    LOCAL VAR num rate := 0;
    LOCAL VAR num needed := 0;
    ! Part of the speeds beside it that the axes can keep in it.
    LOCAL VAR num kept := 1;
    ! Speeds of all axes of a kind together.
    LOCAL VAR num turning := 0;

    LOCAL VAR intnum bell;
    LOCAL VAR intnum look;
    LOCAL VAR intnum speed_bell;
    LOCAL VAR intnum tick;
    ! Percent of the programmed speed that is wanted, for which the point at hand has its time, and
    ! the newest move of the trajectory (0: it is short); percent by SpeedRefresh.
    LOCAL VAR num pace := 100;
    LOCAL VAR num taken := 100;
    LOCAL VAR num latest := 0;
    LOCAL VAR num share := 100;
    LOCAL VAR num repeats := 0;
    ! Percent by the SpeedRefresh of the program itself, to which the driver returns.
    LOCAL VAR num program_share := 100;
    ! Leaves a move whose path is gone, by a long jump out of the trap.
    LOCAL VAR errnum path_gone := -1;
    ! Main moves, or is about to: there the trap may end what it does.
    LOCAL VAR bool in_move := FALSE;
    LOCAL VAR ROS_point point;
    ! The place of the point before it.
    LOCAL VAR jointtarget before;
    ! The corner at it.
    LOCAL VAR zonedata bend;
    ! Trajectory under way here, and the point of it that comes next.
    LOCAL VAR num session := -1;
    LOCAL VAR num expected := 1;
    ! The newest trajectory that gets no more points, as main saw it last.
    LOCAL VAR num closed := 0;
    ! Why a move failed.
    LOCAL VAR num fault := 0;

    PROC main()
        ROS_run;
    ENDPROC

    ! Serve the ring, for ever.
    PROC ROS_run()
        ROS_start_task ROS_shown_motion,
            ROS_BUILD_EVENTS = ROS_BUILD_ID AND ROS_BUILD_INSTRUCTIONS = ROS_BUILD_ID AND
            ROS_BUILD_EXECUTION = ROS_BUILD_ID AND ROS_BUILD_MOTION = ROS_BUILD_ID;
        ROS_service := ROS_OUTSIDE;
        in_move := FALSE;
        IF path_gone = -1 BookErrNo path_gone;
        answer ROS_REASON_PROGRAM_STOPPED;
        ROS_stopped := FALSE;
        ! After PP to main no order is left, after a return of main there is one.
        IDelete bell;
        CONNECT bell WITH on_bell;
        IPers ROS_bell, bell;
        order_look;
        IDelete speed_bell;
        CONNECT speed_bell WITH on_bell;
        IPers ROS_speed_asked, speed_bell;
        IF repeats > 0 say_again;
        set_speed;
        WHILE TRUE DO
            ROS_service := ROS_SERVING;
            serve_ring;
        ENDWHILE
    ENDPROC

    LOCAL PROC serve_ring()
        ! Read before the head of the ring: no point comes after this.
        closed := ROS_closed;
        IF ROS_abort <> ROS_abort_done THEN
            answer ROS_halt_reason;
        ELSEIF fault <> ROS_REASON_NONE THEN
            give_up;
        ELSEIF ROS_head <> ROS_tail THEN
            IF ROS_program = ROS_session THEN
                next_order;
            ELSE
                next_point;
            ENDIF
        ELSEIF closed = ROS_session AND ROS_active() THEN
            finish;
        ELSE
            wait_for_points;
        ENDIF
    ENDPROC

    ! Drop the path, and answer the supervisor who may have asked for it. Only main does: it is in no
    ! move then.
    LOCAL PROC answer(num reason)
        VAR num asked;

        ! Read first: a request that comes meanwhile is not answered by this.
        asked := ROS_abort;
        clear_path;
        IF NOT ROS_cleared THEN
            ! Unanswered: while there may be a path, nobody lets the robot move.
            WaitTime 0.1;
            RETURN;
        ENDIF
        ROS_drop_points reason;
        ROS_plain_ways;
        ROS_start_robot IsStopMoveAct(\FromMoveTask);
        IF IsStopMoveAct(\FromMoveTask) THEN
            WaitTime 0.1;
            RETURN;
        ENDIF
        ! A fault of the trajectory that ends here must not end the next one.
        fault := ROS_REASON_NONE;
        ROS_abort_done := asked;
    ENDPROC

    ! The ring is empty. In the middle of a trajectory the robot stands at the last point that
    ! came, since that had no successor.
    LOCAL PROC wait_for_points()
        VAR bool waited;

        IF ROS_active() AND session = ROS_session ROS_starved := session;
        IF ROS_active() OR ROS_phase = ROS_TRAJ_RECEIVING THEN
            ! Points will be here soon.
            WaitTime 0.008;
        ELSE
            WaitUntil ROS_phase = ROS_TRAJ_RECEIVING OR ROS_head <> ROS_tail
                OR ROS_abort <> ROS_abort_done \MaxTime:=0.2 \TimeFlag:=waited \PollRate:=0.04;
        ENDIF
    ENDPROC

    ! All points of the trajectory were executed: it is done, or it was cut behind them.
    LOCAL PROC finish()
        ROS_plain_ways;
        IF ROS_closed_code = ROS_REASON_NONE THEN
            ROS_done := closed;
        ELSE
            ROS_dead_reason := ROS_closed_code;
            ROS_dead := closed;
        ENDIF
    ENDPROC

    LOCAL PROC next_point()
        VAR num next;
        VAR num arrived;
        VAR num passed;
        VAR bool first;
        VAR bool stops;
        VAR bool waited;
        VAR num asked;

        taken := pace;
        IF share < 100 AND session = ROS_session THEN
            ! SpeedRefresh may hold for one move or for all: its move ends before another is ordered.
            ! One of another trajectory is over: the robot may stand elsewhere by now.
            point.duration := 0.1;
            move fine;
            IF fault = ROS_REASON_NONE AND ROS_abort = ROS_abort_done ROS_reached := ROS_planned;
            RETURN;
        ENDIF
        before := point.target;
        point := ROS_ring{ROS_tail MOD ROS_RING_SIZE + 1};
        next := ROS_next(ROS_tail);
        IF point.session <> ROS_session OR point.session = ROS_dead THEN
            ! Left over from a trajectory that was halted.
            ROS_tail := next;
            RETURN;
        ENDIF
        first := (point.session <> session);
        IF first begin_session point.session;
        IF point.index <> expected THEN
            fault := ROS_REASON_INTERNAL;
            RETURN;
        ENDIF
        passed := ROS_planned;
        arrived := expected;
        expected := (expected + 1) MOD ROS_INDEX_WRAP;
        ROS_starved := -1;
        ROS_tail := next;
        ROS_planned := arrived;
        IF NOT point.dwell point.duration := point.duration * 100 / taken;
        ! The robot stands at the first point, and at one whose successor is not here yet, or is a dwell.
        stops := first OR next = ROS_head OR ROS_ring{next MOD ROS_RING_SIZE + 1}.dwell;
        IF first left_at := 0;
        IF stops OR point.dwell OR CORNER.finep THEN
            take_time 0;
            left_at := 0;
        ELSE
            look_at_corner next;
            asked := point.duration;
            take_time part_after(next);
            IF point.duration > asked look_at_corner next;
        ENDIF
        IF point.duration = 0 THEN
            ! The robot stands there already.
        ELSEIF point.dwell THEN
            WaitUntil ROS_abort <> ROS_abort_done \MaxTime:=point.duration \TimeFlag:=waited \PollRate:=0.04;
        ELSEIF stops THEN
            move fine;
        ELSE
            shape_corner;
            move bend;
            ! The robot is now somewhere before this point, and has passed the one before.
            arrived := passed;
        ENDIF
        IF fault <> ROS_REASON_NONE OR ROS_abort <> ROS_abort_done RETURN;
        ROS_reached := arrived;
    ERROR (path_gone)
        ! The trap comes here: nothing was reached.
        SkipWarn;
        RETURN;
    ENDPROC

    ! A move whose path was cleared never returns on some controllers; so the trap leaves it. A
    ! request that comes before `in_move` is seen here, one that comes later by the trap.
    LOCAL PROC move(zonedata zone)
        ! A speed may have been asked for since the point was taken.
        IDisable;
        IF share >= 100 latest := 0;
        IF point.duration > 0.25 AND taken > latest latest := taken;
        IF pace < latest set_speed;
        IEnable;
        in_move := TRUE;
        IF ROS_abort = ROS_abort_done
            MoveAbsJ point.target \NoEOffs, SPEED \T:=point.duration, zone, torch \WObj:=table;
        in_move := FALSE;
        IF zone.finep THEN
            ! The robot stands: nothing is left that SpeedRefresh could slow down.
            share := 100;
            latest := 0;
        ENDIF
    ERROR
        in_move := FALSE;
        fault := ROS_REASON_MOTION_ERROR;
        IF ERRNO = ERR_COLL_STOP fault := ROS_REASON_COLLISION;
        RETURN;
    ENDPROC

    ! The next instruction of a program. As for points: one that is left over counts for nothing, and the one
    ! that is passed through its zone has not been reached.
    LOCAL PROC next_order()
        VAR num next;
        VAR num arrived;
        VAR bool stops;

        IF share < 100 AND session = ROS_session THEN
            ! As for points: the move that was slowed down ends before another is ordered.
            ROS_end_way;
            carry_out TRUE;
            IF fault = ROS_REASON_NONE AND ROS_abort = ROS_abort_done ROS_reached := ROS_planned;
            RETURN;
        ENDIF
        ROS_fetch_order ROS_tail MOD ROS_RING_SIZE + 1;
        next := ROS_next(ROS_tail);
        IF ROS_ordered.session <> ROS_session OR ROS_ordered.session = ROS_dead THEN
            ROS_tail := next;
            RETURN;
        ENDIF
        IF ROS_ordered.session <> session THEN
            begin_session ROS_ordered.session;
            ROS_prepare_program;
        ENDIF
        IF ROS_ordered.index <> expected THEN
            fault := ROS_REASON_INTERNAL;
            RETURN;
        ENDIF
        arrived := expected;
        expected := (expected + 1) MOD ROS_INDEX_WRAP;
        ROS_starved := -1;
        stops := ROS_order_stops(next);
        IF NOT stops arrived := ROS_planned;
        ROS_tail := next;
        ROS_planned := ROS_ordered.index;
        carry_out stops;
        IF fault <> ROS_REASON_NONE OR ROS_abort <> ROS_abort_done RETURN;
        ROS_reached := arrived;
    ERROR (path_gone)
        ! The trap comes here: nothing was reached.
        SkipWarn;
        RETURN;
    ENDPROC

    ! As `move`: the trap leaves it.
    LOCAL PROC carry_out(bool stops)
        ! The speed that is wanted now is this one's; a move behind which the robot goes on is slowed down by
        ! SpeedRefresh, too.
        IDisable;
        taken := pace;
        IF share >= 100 latest := 0;
        IF ROS_ordered.kind <= ROS_DO_MOVE_C AND taken > latest latest := taken;
        IF pace < latest set_speed;
        IEnable;
        in_move := TRUE;
        IF ROS_abort = ROS_abort_done ROS_execute stops, taken;
        in_move := FALSE;
        fault := ROS_order_fault;
        IF stops THEN
            share := 100;
            latest := 0;
        ENDIF
    ERROR
        in_move := FALSE;
        fault := ROS_REASON_MOTION_ERROR;
        IF ERRNO = ERR_COLL_STOP fault := ROS_REASON_COLLISION;
        RETURN;
    ENDPROC

    LOCAL PROC begin_session(num its)
        session := its;
        expected := 1;
        ROS_planned := 0;
        ROS_reached := 0;
        ROS_started := session;
        IDisable;
        latest := 0;
        set_speed;
        taken := pace;
        IEnable;
    ENDPROC

    ! In a move that begins or ends slower than it is in the middle the TCP exceeds its mean speed, at
    ! most by as much again. Near the highest speed such a move gets the time of its ramps besides.
    ! `after` is the part of the highest speed that is left at its end.
    LOCAL PROC take_time(num after)
        VAR num part;
        VAR num ramp := 0;
        VAR num seconds;

        IF point.duration <= 0 RETURN;
        part := point.least / point.duration;
        IF part > 0.5 THEN
            ramp_of point.target.robax.rax_1 - before.robax.rax_1, TURN_1, ramp;
            ramp_of point.target.robax.rax_2 - before.robax.rax_2, TURN_2, ramp;
            ramp_of point.target.robax.rax_3 - before.robax.rax_3, TURN_3, ramp;
            ramp_of point.target.robax.rax_4 - before.robax.rax_4, TURN_4, ramp;
            ramp_of point.target.robax.rax_5 - before.robax.rax_5, TURN_5, ramp;
            ramp_of point.target.robax.rax_6 - before.robax.rax_6, TURN_6, ramp;
            seconds := (more(part, left_at) + more(part, after)) / (2 * part);
            seconds := point.least + seconds * (BUILD_UP + ramp / point.duration);
            IF seconds > 2 * point.least seconds := 2 * point.least;
            IF seconds > point.duration point.duration := seconds;
        ENDIF
        left_at := point.least / point.duration;
        IF left_at > after left_at := after;
    ENDPROC

    ! The longest time, times its duration, in which an axis reaches its speed in the move at hand.
    LOCAL PROC ramp_of(num way, num acceleration, INOUT num ramp)
        IF Abs(way) > acceleration * ramp ramp := Abs(way) / acceleration;
    ENDPROC

    LOCAL FUNC num more(num part, num than)
        IF part > than RETURN part - than;
        RETURN 0;
    ENDFUNC

    ! Part of the highest TCP speed with which the way behind the one at hand begins.
    LOCAL FUNC num part_after(num next)
        VAR ROS_point after;

        after := ROS_ring{next MOD ROS_RING_SIZE + 1};
        IF after.duration <= 0 RETURN 0;
        RETURN kept * after.least / after.duration * taken / 100;
    ENDFUNC

    ! How the axes change their speeds from those of the way to the point to those of the way to its
    ! successor: `rate`, `needed`, and the speeds of all axes of a kind together.
    LOCAL PROC look_at_corner(num next)
        VAR ROS_point after;
        VAR num leaving;
        ! 0: as fast on both sides, 1: at rest on one.
        VAR num uneven := 0;
        ! mm of each way that the corner may take, at most half of it.
        VAR num room;

        rate := 9E9;
        needed := 0;
        kept := 1;
        turning := 0;
        after := ROS_ring{next MOD ROS_RING_SIZE + 1};
        ! It may be a first point, of another trajectory, at which the robot stands.
        IF after.duration <= 0 OR point.duration <= 0 RETURN;
        after.duration := after.duration * 100 / taken;
        rate := tcp_speed(before, point.target, point.duration);
        leaving := tcp_speed(point.target, after.target, after.duration);
        room := CORNER.pzone_tcp;
        IF rate * point.duration < 2 * room room := rate * point.duration / 2;
        IF leaving * after.duration < 2 * room room := leaving * after.duration / 2;
        IF rate + leaving > RESTING uneven := Abs(leaving - rate) / (rate + leaving);
        IF rate < leaving rate := leaving;
        turn (after.target.robax.rax_1 - point.target.robax.rax_1) / after.duration,
            (point.target.robax.rax_1 - before.robax.rax_1) / point.duration, TURN_1, uneven, turning;
        turn (after.target.robax.rax_2 - point.target.robax.rax_2) / after.duration,
            (point.target.robax.rax_2 - before.robax.rax_2) / point.duration, TURN_2, uneven, turning;
        turn (after.target.robax.rax_3 - point.target.robax.rax_3) / after.duration,
            (point.target.robax.rax_3 - before.robax.rax_3) / point.duration, TURN_3, uneven, turning;
        turn (after.target.robax.rax_4 - point.target.robax.rax_4) / after.duration,
            (point.target.robax.rax_4 - before.robax.rax_4) / point.duration, TURN_4, uneven, turning;
        turn (after.target.robax.rax_5 - point.target.robax.rax_5) / after.duration,
            (point.target.robax.rax_5 - before.robax.rax_5) / point.duration, TURN_5, uneven, turning;
        turn (after.target.robax.rax_6 - point.target.robax.rax_6) / after.duration,
            (point.target.robax.rax_6 - before.robax.rax_6) / point.duration, TURN_6, uneven, turning;
        IF rate * needed > 2 * room kept := Sqrt(2 * room / (rate * needed));
    ENDPROC

    ! The time `needed` for a corner is long enough for one axis, and `sum` has its speed, too. In
    ! an uneven corner, as wide on both sides but longer on one, it has to change more.
    LOCAL PROC turn(num leaving, num arriving, num acceleration, num uneven, INOUT num sum)
        VAR num faster;
        VAR num change;

        faster := Abs(arriving);
        IF faster < Abs(leaving) faster := Abs(leaving);
        change := Abs(leaving - arriving) + uneven * faster;
        IF change > acceleration * needed needed := change / acceleration;
        sum := sum + faster;
    ENDPROC

    ! The zone in which the axes do that. On its faster side the TCP is in it for half of the time that
    ! this takes, on the other for longer. Angles and external axes count where the TCP rests; where
    ! it moves they must not shrink its zone.
    LOCAL PROC shape_corner()
        bend := CORNER;
        IF needed < SHORTEST_CORNER needed := SHORTEST_CORNER;
        bend.pzone_tcp := between(SMALLEST_CORNER, rate * needed / 2, CORNER.pzone_tcp);
        ! To each other as in the zone.
        bend.pzone_ori := bend.pzone_tcp * CORNER.pzone_ori / CORNER.pzone_tcp;
        bend.pzone_eax := bend.pzone_ori;
        IF rate > RESTING RETURN;
        bend.zone_ori := between(SMALLEST_TURN, turning * needed / 2, CORNER.zone_ori);
    ENDPROC

    LOCAL FUNC num between(num least, num wanted, num most)
        IF wanted < least RETURN least;
        IF wanted < most RETURN wanted;
        RETURN most;
    ENDFUNC

    ! mm/s of the TCP on the way from one point to the next. Where that cannot be told a corner is as
    ! large as it may be.
    LOCAL FUNC num tcp_speed(jointtarget from_point, jointtarget to_point, num seconds)
        VAR robtarget start;
        VAR robtarget end_point;

        start := CalcRobT(from_point, torch \WObj:=table);
        end_point := CalcRobT(to_point, torch \WObj:=table);
        ! Not Distance: programs have a global of that name, which would hide it.
        RETURN VectMagn(end_point.trans - start.trans) / seconds;
    ERROR
        SkipWarn;
        RETURN 9E9;
    ENDFUNC

    ! Find the speed that is wanted for the trajectory under way: points get their time for it. A long
    ! move that has its time already is slowed down by SpeedRefresh.
    LOCAL PROC set_speed()
        VAR num asked;
        VAR num percent := 100;
        VAR num due := 100;

        asked := ROS_speed_asked;
        IF ROS_speed_of = ROS_session AND ROS_active() percent := ROS_speed_wanted;
        IF percent < latest due := 100 * percent / latest;
        IF due <> share THEN
            ! Only when nothing of the driver's own is in effect, or may be.
            IF share >= 100 AND repeats = 0 program_share := refreshed();
            SpeedRefresh due * program_share / 100;
            share := due;
            repeats := 5;
            say_again;
        ENDIF
        pace := percent;
        ROS_speed_done := asked;
    ERROR
        ! Not answered: whoever asked is told that it was not done.
        SkipWarn;
        RETURN;
    ENDPROC

    ! Percent by SpeedRefresh: what the task has, of what the operator has set.
    LOCAL FUNC num refreshed()
        VAR num percent;

        IF CSpeedOverride() <= 0 RETURN 100;
        percent := 100 * CSpeedOverride(\CTask) / CSpeedOverride();
        IF 0 <= percent AND percent <= 100 RETURN percent;
        RETURN 100;
    ENDFUNC

    ! It may hold for one move only, and do nothing at a standstill. One bell at a time may wait.
    LOCAL PROC say_again()
        IDelete tick;
        CONNECT tick WITH on_tick;
        ITimer \Single, 0.1, tick;
    ENDPROC

    LOCAL TRAP on_tick
        IF share < 100 OR (NOT in_move) OR IsStopMoveAct() repeats := 5;
        repeats := repeats - 1;
        IF repeats > 0 say_again;
        SpeedRefresh share * program_share / 100;
    ERROR
        SkipWarn;
        RETURN;
    ENDTRAP

    ! This task itself ends the trajectory.
    LOCAL PROC give_up()
        IF ROS_active() ErrWrite "ROS: trajectory ended early", ROS_reason_text(fault)
            \RL2:="At point " + ValToStr(ROS_planned - 1) + ".";
        ROS_stop_robot;
        answer fault;
    ENDPROC

    ! ROS_cleared: the robot stands, and nothing is left of its path.
    LOCAL PROC clear_path()
        ROS_cleared := FALSE;
        WaitRob \ZeroSpeed;
        ROS_clear_path;
        IF ROS_cleared share := 100;
    ERROR
        SkipWarn;
        RETURN;
    ENDPROC

    ! Without the supervisor nothing can stop the robot: what is under way ends. Main gives it up.
    LOCAL TRAP on_look
        order_look;
        ROS_watch_supervisor;
        IF (NOT ROS_unsupervised) OR (NOT ROS_active()) OR fault <> ROS_REASON_NONE RETURN;
        fault := ROS_REASON_TASK_ENDED;
        ROS_stop_robot;
        clear_path;
        IF NOT in_move RETURN;
        in_move := FALSE;
        RAISE path_gone;
    ERROR
        SkipWarn;
        RAISE;
    ENDTRAP

    ! One at a time may wait, also while the program is stopped.
    LOCAL PROC order_look()
        IDelete look;
        CONNECT look WITH on_look;
        ITimer \SingleSafe, 0.1, look;
    ENDPROC

    ! The supervisor has stopped the robot and wants the path to be dropped. Main may be waiting
    ! in a move, which may never return when its path is gone: it is left. Main then answers.
    LOCAL TRAP on_bell
        IF ROS_speed_asked <> ROS_speed_done set_speed;
        IF ROS_abort = ROS_abort_done RETURN;
        clear_path;
        IF NOT in_move RETURN;
        ! Now: a bell may ring again before main does anything.
        in_move := FALSE;
        RAISE path_gone;
    ERROR
        SkipWarn;
        RAISE;
    ENDTRAP
ENDMODULE
