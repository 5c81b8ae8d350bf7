MODULE ROS_motion
    ! The motion task: the only task that moves the robot.
    !
    ! Robot "two_arms_track-rw6", motion group rob2, T_ROB2. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! This task only takes points out of the ring buffer and gives them to the path planner. All checks
    ! were made before a point was put in. A point whose successor has arrived is passed through its
    ! zone. A point without a successor is a stop point, so the planner never lacks the next move in a
    ! corner.

    CONST string ROS_BUILD_MOTION := "5273285319d5";

    ! The moves have a programmed time (\T), so this speed is only formal.
    LOCAL CONST speeddata FORMAL_SPEED := [5000,500,5000,1000];
    LOCAL CONST zonedata CONFIG_ZONE := z50;
    ! Time between two checks for points during a trajectory, s. It is short compared with the duration
    ! of a point.
    LOCAL CONST num POLL_PERIOD := 0.008;
    ! Without a trajectory this task checks every POLL_RATE (s), and looks at everything else every
    ! IDLE_TIMEOUT (s). Longer, and the robot would start late; shorter, and other tasks would have less
    ! time.
    LOCAL CONST num IDLE_TIMEOUT := 0.2;
    LOCAL CONST num POLL_RATE := 0.04;
    ! Time until a path that could not be cleared, or a stop that could not be reset, is tried again, s.
    LOCAL CONST num RETRY_PERIOD := 0.1;
    ! Time between two repetitions of SpeedRefresh, s; duration of the stop that is added at the target of
    ! a slowed move, s; and longest move that is not slowed down, s: it is over before SpeedRefresh would
    ! take effect.
    LOCAL CONST num REFRESH_PERIOD := 0.1;
    LOCAL CONST num REST_DURATION := 0.1;
    LOCAL CONST num MIN_SLOWED_MOVE := 0.25;
    ! Number of these repetitions while the robot moves at full speed: then one of them was in effect.
    LOCAL CONST num MAX_REFRESHES := 5;
    ! Acceleration that each axis certainly reaches, deg/s^2 or mm/s^2 (30 % of its estimated value).
    LOCAL CONST num ACCELERATION_1 := 750;
    LOCAL CONST num ACCELERATION_2 := 750;
    LOCAL CONST num ACCELERATION_3 := 750;
    LOCAL CONST num ACCELERATION_4 := 1371.4286;
    LOCAL CONST num ACCELERATION_5 := 1371.4286;
    LOCAL CONST num ACCELERATION_6 := 1800;
    ! A corner zone is as small as the axes can follow without slowing down, and at most CONFIG_ZONE.
    ! The corner is planned for at least MIN_CORNER_TIME (s; an estimate, ABB publishes no value). The
    ! zone is not smaller than MIN_ZONE_MM (mm) and MIN_ZONE_DEG (deg).
    LOCAL CONST num MIN_CORNER_TIME := 0.025;
    LOCAL CONST num MIN_ZONE_MM := 0.3;
    LOCAL CONST num MIN_ZONE_DEG := 0.03;
    ! A TCP below this speed is at rest, mm/s: its computed position is not more accurate.
    LOCAL CONST num REST_TCP_SPEED := 0.1;

    ! Corner at the present point: TCP speed on its faster side (mm/s), and time that the axes need for
    ! it (s).
    LOCAL VAR num corner_speed := 0;
    LOCAL VAR num corner_time := 0;
    ! Sums of the speeds of all axes of one kind, deg/s or mm/s.
    LOCAL VAR num robot_speed_sum := 0;

    LOCAL VAR intnum int_wakeup;
    LOCAL VAR intnum int_supervision;
    LOCAL VAR intnum int_speed;
    LOCAL VAR intnum int_timer;
    ! Requested speed, speed for which the time of the present point was computed, speed of the newest
    ! move (0: it is too short to be slowed down), and speed that SpeedRefresh has set. All are percent.
    LOCAL VAR num speed_percent := 100;
    LOCAL VAR num point_percent := 100;
    LOCAL VAR num move_percent := 0;
    LOCAL VAR num refresh_percent := 100;
    LOCAL VAR num refresh_repeats := 0;
    ! SpeedRefresh value of the program itself, to which the driver returns, percent.
    LOCAL VAR num program_percent := 100;
    ! Error number of the long jump by which a trap leaves a move whose path was cleared.
    LOCAL VAR errnum err_path_cleared := -1;
    ! TRUE while main executes a move. The trap may abort main only then.
    LOCAL VAR bool in_move := FALSE;
    LOCAL VAR ROS_point point;
    ! Target of the previous point.
    LOCAL VAR jointtarget previous;
    ! Zone at the present point.
    LOCAL VAR zonedata corner_zone;
    ! Number of the trajectory that this task executes, and index of its next point.
    LOCAL VAR num trajectory := -1;
    LOCAL VAR num expected_index := 1;
    ! Newest trajectory that gets no more points, as main has last read it.
    LOCAL VAR num closed_seen := 0;
    ! Reason why a move failed (ROS_REASON_...).
    LOCAL VAR num fault := 0;

    PROC main()
        ROS_run;
    ENDPROC

    ! Execute trajectories. This routine does not return.
    PROC ROS_run()
        ROS_start_task ROS_task_build_motion_2,
            ROS_BUILD_EXECUTION = ROS_BUILD_ID AND ROS_BUILD_MOTION = ROS_BUILD_ID;
        ROS_run_state_2 := ROS_RUN_OUTSIDE;
        in_move := FALSE;
        IF err_path_cleared = -1 BookErrNo err_path_cleared;
        answer_supervisor ROS_REASON_PROGRAM_STOPPED;
        ROS_stopped_2 := FALSE;
        ! After PP to main no interrupt is connected; after a return of main there is one.
        IDelete int_wakeup;
        CONNECT int_wakeup WITH on_wakeup;
        IPers ROS_wakeup_2, int_wakeup;
        start_supervision_timer;
        IDelete int_speed;
        CONNECT int_speed WITH on_wakeup;
        IPers ROS_speed_asked_2, int_speed;
        IF refresh_repeats > 0 resend;
        set_speed;
        WHILE TRUE DO
            ROS_run_state_2 := ROS_RUN_SERVING;
            serve_ring;
        ENDWHILE
    ENDPROC

    LOCAL PROC serve_ring()
        ! Read this before the head of the ring buffer: then no point is added after it.
        closed_seen := ROS_closed_trajectory_2;
        IF ROS_abort_2 <> ROS_abort_done_2 THEN
            answer_supervisor ROS_halt_reason_2;
        ELSEIF fault <> ROS_REASON_NONE THEN
            abort_trajectory;
        ELSEIF ROS_head_2 <> ROS_tail_2 THEN
            IF ROS_program_number_2 = ROS_active_trajectory_2 THEN
                next_instruction;
            ELSE
                next_point;
            ENDIF
        ELSEIF closed_seen = ROS_active_trajectory_2 AND ROS_is_active() THEN
            finish_trajectory;
        ELSE
            wait_for_points;
        ENDIF
    ENDPROC

    ! Drop the path and answer a request of the supervisor. Only main does this, outside of any move.
    LOCAL PROC answer_supervisor(num reason)
        VAR num request;

        ! Read the request first: a later one is not answered by this.
        request := ROS_abort_2;
        clear_path;
        IF NOT ROS_path_cleared THEN
            ! Do not answer: while a path may exist, the robot must stay stopped.
            WaitTime RETRY_PERIOD;
            RETURN;
        ENDIF
        ROS_drop_trajectory reason;
        ROS_reset_path_mode;
        ROS_start_robot IsStopMoveAct(\FromMoveTask);
        IF IsStopMoveAct(\FromMoveTask) THEN
            WaitTime RETRY_PERIOD;
            RETURN;
        ENDIF
        ! A fault of the trajectory that ends here must not end the next one.
        fault := ROS_REASON_NONE;
        ROS_abort_done_2 := request;
    ENDPROC

    ! The ring buffer is empty. During a trajectory the robot stands at the last point that arrived,
    ! because that point had no successor.
    LOCAL PROC wait_for_points()
        VAR bool timed_out;

        IF ROS_is_active() AND trajectory = ROS_active_trajectory_2 ROS_starved_trajectory_2 := trajectory;
        IF ROS_is_active() OR ROS_phase_2 = ROS_TRAJ_RECEIVING THEN
            ! The next points will arrive soon.
            WaitTime POLL_PERIOD;
        ELSE
            ! A trajectory may be received and started between two checks, and its points follow.
            WaitUntil ROS_phase_2 = ROS_TRAJ_RECEIVING OR ROS_is_active() OR ROS_head_2 <> ROS_tail_2
                OR ROS_abort_2 <> ROS_abort_done_2 \MaxTime:=IDLE_TIMEOUT \TimeFlag:=timed_out \PollRate:=POLL_RATE;
        ENDIF
    ENDPROC

    ! All points of the trajectory were executed. It is complete or was cut after them.
    LOCAL PROC finish_trajectory()
        ROS_reset_path_mode;
        IF ROS_closed_code_2 = ROS_REASON_NONE THEN
            ROS_done_trajectory_2 := closed_seen;
        ELSE
            ROS_ended_early_reason_2 := ROS_closed_code_2;
            ROS_ended_early_2 := closed_seen;
        ENDIF
    ENDPROC

    LOCAL PROC next_point()
        VAR num next_tail;
        VAR num reached_index;
        VAR num passed_index;
        VAR bool first;
        VAR bool stops;
        VAR bool timed_out;

        point_percent := speed_percent;
        IF refresh_percent < 100 AND trajectory = ROS_active_trajectory_2 THEN
            ! SpeedRefresh may hold for one move or for all moves. The slowed move therefore ends before
            ! the next one is ordered. A move of an earlier trajectory is over, and the robot may be
            ! elsewhere.
            point.duration := REST_DURATION;
            move fine;
            IF fault = ROS_REASON_NONE AND ROS_abort_2 = ROS_abort_done_2 ROS_reached_2 := ROS_planned_2;
            RETURN;
        ENDIF
        previous := point.target;
        point := ROS_ring_2{ROS_tail_2 MOD ROS_RING_SIZE + 1};
        next_tail := ROS_next_count(ROS_tail_2);
        IF point.trajectory <> ROS_active_trajectory_2 OR point.trajectory = ROS_ended_early_2 THEN
            ! This point belongs to a trajectory that was halted.
            ROS_tail_2 := next_tail;
            RETURN;
        ENDIF
        first := (point.trajectory <> trajectory);
        IF first begin_trajectory point.trajectory;
        IF point.index <> expected_index THEN
            fault := ROS_REASON_INTERNAL;
            RETURN;
        ENDIF
        passed_index := ROS_planned_2;
        reached_index := expected_index;
        expected_index := (expected_index + 1) MOD ROS_INDEX_WRAP;
        ROS_starved_trajectory_2 := -1;
        ROS_tail_2 := next_tail;
        ROS_planned_2 := reached_index;
        IF NOT point.dwell point.duration := point.duration * 100 / point_percent;
        ! The robot stops at the first point, at a point without a successor, and before a dwell.
        stops := first OR next_tail = ROS_head_2 OR ROS_ring_2{next_tail MOD ROS_RING_SIZE + 1}.dwell;
        IF point.duration = 0 THEN
            ! The robot stands at this point already.
        ELSEIF point.dwell THEN
            WaitUntil ROS_abort_2 <> ROS_abort_done_2 \MaxTime:=point.duration \TimeFlag:=timed_out \PollRate:=POLL_RATE;
        ELSEIF stops THEN
            move fine;
        ELSE
            check_corner next_tail;
            shape_corner;
            move corner_zone;
            ! The robot has passed the previous point, but has not reached this one.
            reached_index := passed_index;
        ENDIF
        IF fault <> ROS_REASON_NONE OR ROS_abort_2 <> ROS_abort_done_2 RETURN;
        ROS_reached_2 := reached_index;
    ERROR (err_path_cleared)
        ! The trap jumps here. No point was reached.
        SkipWarn;
        RETURN;
    ENDPROC

    ! Execute one move. On some controllers a move whose path was cleared never returns, so the trap
    ! leaves it by a long jump. A request before `in_move` is TRUE is noticed here, a later one by the
    ! trap.
    LOCAL PROC move(zonedata zone)
        ! The requested speed may have changed since the point was taken.
        IDisable;
        IF refresh_percent >= 100 move_percent := 0;
        IF point.duration > MIN_SLOWED_MOVE AND point_percent > move_percent move_percent := point_percent;
        IF speed_percent < move_percent set_speed;
        IEnable;
        in_move := TRUE;
        IF ROS_abort_2 = ROS_abort_done_2
            MoveAbsJ point.target \NoEOffs, FORMAL_SPEED \T:=point.duration, zone, tool0 \WObj:=wobj0;
        in_move := FALSE;
        IF zone.finep THEN
            ! The robot stands, so SpeedRefresh affects no move any more.
            refresh_percent := 100;
            move_percent := 0;
        ENDIF
    ERROR
        in_move := FALSE;
        fault := ROS_REASON_MOTION_ERROR;
        IF ERRNO = ERR_COLL_STOP fault := ROS_REASON_COLLISION;
        RETURN;
    ENDPROC

    ! Execute the next instruction of a program. As for points, instructions of a halted program are
    ! skipped, and an instruction that is passed through its zone has not been reached.
    LOCAL PROC next_instruction()
        VAR num next_tail;
        VAR num reached_index;
        VAR bool stops;

        IF refresh_percent < 100 AND trajectory = ROS_active_trajectory_2 THEN
            ! As for points, the slowed move ends before the next one is ordered.
            ROS_end_at_target;
            execute_instruction TRUE;
            IF fault = ROS_REASON_NONE AND ROS_abort_2 = ROS_abort_done_2 ROS_reached_2 := ROS_planned_2;
            RETURN;
        ENDIF
        ROS_fetch_instr ROS_tail_2 MOD ROS_RING_SIZE + 1;
        next_tail := ROS_next_count(ROS_tail_2);
        IF ROS_current_instr.trajectory <> ROS_active_trajectory_2
            OR ROS_current_instr.trajectory = ROS_ended_early_2 THEN
            ROS_tail_2 := next_tail;
            RETURN;
        ENDIF
        IF ROS_current_instr.trajectory <> trajectory THEN
            begin_trajectory ROS_current_instr.trajectory;
            ROS_prepare_program;
        ENDIF
        IF ROS_current_instr.index <> expected_index THEN
            fault := ROS_REASON_INTERNAL;
            RETURN;
        ENDIF
        reached_index := expected_index;
        expected_index := (expected_index + 1) MOD ROS_INDEX_WRAP;
        ROS_starved_trajectory_2 := -1;
        stops := ROS_instr_stops(next_tail);
        IF NOT stops reached_index := ROS_planned_2;
        ROS_tail_2 := next_tail;
        ROS_planned_2 := ROS_current_instr.index;
        execute_instruction stops;
        IF fault <> ROS_REASON_NONE OR ROS_abort_2 <> ROS_abort_done_2 RETURN;
        ROS_reached_2 := reached_index;
    ERROR (err_path_cleared)
        ! The trap jumps here. No instruction was reached.
        SkipWarn;
        RETURN;
    ENDPROC

    ! Execute one instruction. The trap leaves it as it leaves `move`.
    LOCAL PROC execute_instruction(bool stops)
        ! This move has the speed that is requested now. SpeedRefresh also slows down a move after which
        ! the robot does not stop.
        IDisable;
        point_percent := speed_percent;
        IF refresh_percent >= 100 move_percent := 0;
        IF ROS_current_instr.kind <= ROS_DO_MOVE_C AND point_percent > move_percent move_percent := point_percent;
        IF speed_percent < move_percent set_speed;
        IEnable;
        in_move := TRUE;
        IF ROS_abort_2 = ROS_abort_done_2 ROS_execute stops, point_percent;
        in_move := FALSE;
        fault := ROS_instr_fault;
        IF stops THEN
            refresh_percent := 100;
            move_percent := 0;
        ENDIF
    ERROR
        in_move := FALSE;
        fault := ROS_REASON_MOTION_ERROR;
        IF ERRNO = ERR_COLL_STOP fault := ROS_REASON_COLLISION;
        RETURN;
    ENDPROC

    LOCAL PROC begin_trajectory(num number)
        trajectory := number;
        expected_index := 1;
        ROS_planned_2 := 0;
        ROS_reached_2 := 0;
        ROS_started_trajectory_2 := trajectory;
        IDisable;
        move_percent := 0;
        set_speed;
        point_percent := speed_percent;
        IEnable;
    ENDPROC

    ! Compute how the axes change their speeds in the corner at the present point: `corner_speed`,
    ! `corner_time`, and the sums of the speeds.
    LOCAL PROC check_corner(num next_tail)
        VAR ROS_point following;
        VAR num speed_out;
        ! 0: equal speeds on both sides of the corner; 1: at rest on one side.
        VAR num unevenness := 0;

        corner_speed := 9E9;
        corner_time := 0;
        robot_speed_sum := 0;
        following := ROS_ring_2{next_tail MOD ROS_RING_SIZE + 1};
        ! The next point may be the first one of another trajectory, at which the robot stands.
        IF following.duration <= 0 OR point.duration <= 0 RETURN;
        following.duration := following.duration * 100 / point_percent;
        corner_speed := tcp_speed(previous, point.target, point.duration);
        speed_out := tcp_speed(point.target, following.target, following.duration);
        IF corner_speed + speed_out > REST_TCP_SPEED
            unevenness := Abs(speed_out - corner_speed) / (corner_speed + speed_out);
        IF corner_speed < speed_out corner_speed := speed_out;
        add_axis (following.target.robax.rax_1 - point.target.robax.rax_1) / following.duration,
            (point.target.robax.rax_1 - previous.robax.rax_1) / point.duration,
            ACCELERATION_1, unevenness, robot_speed_sum;
        add_axis (following.target.robax.rax_2 - point.target.robax.rax_2) / following.duration,
            (point.target.robax.rax_2 - previous.robax.rax_2) / point.duration,
            ACCELERATION_2, unevenness, robot_speed_sum;
        add_axis (following.target.robax.rax_3 - point.target.robax.rax_3) / following.duration,
            (point.target.robax.rax_3 - previous.robax.rax_3) / point.duration,
            ACCELERATION_3, unevenness, robot_speed_sum;
        add_axis (following.target.robax.rax_4 - point.target.robax.rax_4) / following.duration,
            (point.target.robax.rax_4 - previous.robax.rax_4) / point.duration,
            ACCELERATION_4, unevenness, robot_speed_sum;
        add_axis (following.target.robax.rax_5 - point.target.robax.rax_5) / following.duration,
            (point.target.robax.rax_5 - previous.robax.rax_5) / point.duration,
            ACCELERATION_5, unevenness, robot_speed_sum;
        add_axis (following.target.robax.rax_6 - point.target.robax.rax_6) / following.duration,
            (point.target.robax.rax_6 - previous.robax.rax_6) / point.duration,
            ACCELERATION_6, unevenness, robot_speed_sum;
    ENDPROC

    ! Increase `corner_time` until it is long enough for this axis. Add its speed to `sum`.
    ! In an uneven corner, which is equally wide on both sides but takes longer on one, its speed changes
    ! more.
    LOCAL PROC add_axis(num speed_out, num speed_in, num acceleration, num unevenness, INOUT num sum)
        VAR num faster;
        VAR num change;

        faster := Abs(speed_in);
        IF faster < Abs(speed_out) faster := Abs(speed_out);
        change := Abs(speed_out - speed_in) + unevenness * faster;
        IF change > acceleration * corner_time corner_time := change / acceleration;
        sum := sum + faster;
    ENDPROC

    ! Compute the zone in which the axes can follow the corner. On the faster side the TCP is in the
    ! zone for half of corner_time. Angles and external axes determine the zone only where the TCP
    ! rests; elsewhere they must not make it smaller.
    LOCAL PROC shape_corner()
        corner_zone := CONFIG_ZONE;
        IF corner_time < MIN_CORNER_TIME corner_time := MIN_CORNER_TIME;
        corner_zone.pzone_tcp := limit_value(MIN_ZONE_MM, corner_speed * corner_time / 2, CONFIG_ZONE.pzone_tcp);
        ! The sizes have the same ratio as those of the configured zone.
        corner_zone.pzone_ori := corner_zone.pzone_tcp * CONFIG_ZONE.pzone_ori / CONFIG_ZONE.pzone_tcp;
        corner_zone.pzone_eax := corner_zone.pzone_ori;
        IF corner_speed > REST_TCP_SPEED RETURN;
        corner_zone.zone_ori := limit_value(MIN_ZONE_DEG, robot_speed_sum * corner_time / 2, CONFIG_ZONE.zone_ori);
    ENDPROC

    LOCAL FUNC num limit_value(num minimum, num value, num maximum)
        IF value < minimum RETURN minimum;
        IF value < maximum RETURN value;
        RETURN maximum;
    ENDFUNC

    ! Return the TCP speed between two points, mm/s. If CalcRobT fails, the result makes the corner as
    ! large as the configured zone.
    LOCAL FUNC num tcp_speed(jointtarget from_point, jointtarget to_point, num seconds)
        VAR robtarget start;
        VAR robtarget end_point;

        start := CalcRobT(from_point, tool0 \WObj:=wobj0);
        end_point := CalcRobT(to_point, tool0 \WObj:=wobj0);
        ! Distance is not used here, because a program may declare a global of that name, which would
        ! hide it.
        RETURN VectMagn(end_point.trans - start.trans) / seconds;
    ERROR
        SkipWarn;
        RETURN 9E9;
    ENDFUNC

    ! Set the requested speed of the active trajectory. New points get their time for it. A long move
    ! that already has its time is slowed down by SpeedRefresh.
    LOCAL PROC set_speed()
        VAR num request;
        VAR num percent := 100;
        VAR num target_percent := 100;

        request := ROS_speed_asked_2;
        IF ROS_speed_trajectory_2 = ROS_active_trajectory_2 AND ROS_is_active() percent := ROS_speed_percent_2;
        IF percent < move_percent target_percent := 100 * percent / move_percent;
        IF target_percent <> refresh_percent THEN
            ! Read the program's value only while no SpeedRefresh of the driver is, or may be, in
            ! effect.
            IF refresh_percent >= 100 AND refresh_repeats = 0 program_percent := program_refresh();
            SpeedRefresh target_percent * program_percent / 100;
            refresh_percent := target_percent;
            refresh_repeats := MAX_REFRESHES;
            resend;
        ENDIF
        speed_percent := percent;
        ROS_speed_done_2 := request;
    ERROR
        ! The request stays unanswered, so the client is informed that the speed was not set.
        SkipWarn;
        RETURN;
    ENDPROC

    ! Return the SpeedRefresh value of the program itself, percent.
    LOCAL FUNC num program_refresh()
        VAR num percent;

        IF CSpeedOverride() <= 0 RETURN 100;
        percent := 100 * CSpeedOverride(\CTask) / CSpeedOverride();
        IF 0 <= percent AND percent <= 100 RETURN percent;
        RETURN 100;
    ENDFUNC

    ! Repeat SpeedRefresh every REFRESH_PERIOD, because it may hold for one move only and have no effect at a
    ! standstill. Only one interrupt may be pending.
    LOCAL PROC resend()
        IDelete int_timer;
        CONNECT int_timer WITH on_timer;
        ITimer \Single, REFRESH_PERIOD, int_timer;
    ENDPROC

    LOCAL TRAP on_timer
        IF refresh_percent < 100 OR (NOT in_move) OR IsStopMoveAct() refresh_repeats := MAX_REFRESHES;
        refresh_repeats := refresh_repeats - 1;
        IF refresh_repeats > 0 resend;
        SpeedRefresh refresh_percent * program_percent / 100;
    ERROR
        SkipWarn;
        RETURN;
    ENDTRAP

    ! End the trajectory because of a fault that this task has detected.
    LOCAL PROC abort_trajectory()
        IF ROS_is_active() ErrWrite "ROS: trajectory ended early", ROS_reason_text(fault)
            \RL2:="At point " + ValToStr(ROS_planned_2 - 1) + ".";
        ROS_stop_robot;
        answer_supervisor fault;
    ENDPROC

    ! Clear the path when the robot stands. ROS_path_cleared reports the success.
    LOCAL PROC clear_path()
        ROS_path_cleared := FALSE;
        WaitRob \ZeroSpeed;
        ROS_clear_path;
        IF ROS_path_cleared refresh_percent := 100;
    ERROR
        SkipWarn;
        RETURN;
    ENDPROC

    ! The supervisor has ended, so nothing else can stop the robot. End the trajectory; main then aborts
    ! it.
    LOCAL TRAP on_supervision
        start_supervision_timer;
        ROS_watch_supervisor;
        IF (NOT ROS_supervisor_missing) OR (NOT ROS_is_active()) OR fault <> ROS_REASON_NONE RETURN;
        fault := ROS_REASON_TASK_ENDED;
        ROS_stop_robot;
        clear_path;
        IF NOT in_move RETURN;
        in_move := FALSE;
        RAISE err_path_cleared;
    ERROR
        SkipWarn;
        RAISE;
    ENDTRAP

    ! Only one interrupt may be pending, also while the program is stopped.
    LOCAL PROC start_supervision_timer()
        IDelete int_supervision;
        CONNECT int_supervision WITH on_supervision;
        ITimer \SingleSafe, ROS_ALIVE_PERIOD, int_supervision;
    ENDPROC

    ! The supervisor has stopped the robot and requests that the path be dropped. Main may be waiting in
    ! a move, which may never return once its path is cleared. This trap leaves it, and main then
    ! answers.
    LOCAL TRAP on_wakeup
        IF ROS_speed_asked_2 <> ROS_speed_done_2 set_speed;
        IF ROS_abort_2 = ROS_abort_done_2 RETURN;
        clear_path;
        IF NOT in_move RETURN;
        ! Reset it now, because the next wake-up may come before main continues.
        in_move := FALSE;
        RAISE err_path_cleared;
    ERROR
        SkipWarn;
        RAISE;
    ENDTRAP
ENDMODULE
