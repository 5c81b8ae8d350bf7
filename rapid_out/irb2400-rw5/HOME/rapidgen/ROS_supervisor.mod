MODULE ROS_supervisor
    ! The supervisor: the only task that stops and restarts the robot.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds accept no trajectory.
    !
    ! A halt takes three steps. StopMove stops the robot and stays in force (latched). The motion task
    ! is asked to drop its path. After it has done so, StartMove on the empty path resets the stop. If
    ! one of the steps fails, the robot stays stopped. The supervisor halts the robot on request, and
    ! after events after which the old path must not continue: emergency stop, motors off, program stop,
    ! change of mode.
    ! A pause is StopMove alone, so that the path is kept. StartMove on request resumes the motion.

    CONST string ROS_BUILD_SUPERVISOR := "a68c3bfb8285";

    LOCAL VAR intnum int_stop;
    LOCAL VAR intnum int_check;
    LOCAL VAR intnum int_control;
    LOCAL VAR intnum int_pause;
    LOCAL VAR num mode := 0;
    LOCAL VAR clock clock_wakeup;
    LOCAL VAR clock clock_halt;
    ! Wake-up interrupts since the halt, and their largest number. A program that does not execute them
    ! would end with too many of them pending (40223).
    LOCAL VAR num wakeups := 0;
    LOCAL CONST num MAX_WAKEUPS := 12;
    ! Shortest time between two wake-up interrupts, s. The motion task drops its path in less.
    LOCAL CONST num WAKEUP_PERIOD := 0.25;
    ! Time after which a robot that stays stopped is reported, s: a halt is over in less.
    LOCAL CONST num REPORT_DELAY := 2;
    ! For each server: its last alive count, the number of checks without a change, and whether its end
    ! was reported. The checks start at -20, so a server may start 2 s later than this task.
    LOCAL VAR num last_alive_count{3};
    LOCAL VAR num unchanged_checks{3} := [-20,-20,-20];
    LOCAL VAR bool ended_reported{3};
    LOCAL VAR bool server_ended := FALSE;
    LOCAL VAR num alive_count := 0;
    ! TRUE when the reason why the robot stays stopped was written to the event log.
    LOCAL VAR bool is_reported := FALSE;
    ! Number of rounds in which the tasks had modules of different builds, and number of them before
    ! this is reported: the tasks start one after another (2 s).
    LOCAL CONST num MAX_MIXED_ROUNDS := 20;
    LOCAL VAR num mixed_rounds := 0;

    PROC main()
        ROS_start_task ROS_task_build_supervisor, ROS_BUILD_SUPERVISOR = ROS_BUILD_ID;
        ! A halt from before a power failure may not be complete, so the motion task may be asked again.
        ROS_start_clock clock_wakeup;
        ROS_start_clock clock_halt;
        ! A motion that was active when this task ended must not continue.
        IF ROS_is_active() OR (ROS_paused_trajectory >= 0 AND IsStopMoveAct(\FromNonMoveTask))
            halt ROS_REASON_POWER_FAILURE;
        ! On a controller on which the driver was just installed this is 0, which would be a pause.
        ROS_paused_trajectory := -1;
        mode := OpMode();
        IDelete int_stop;
        CONNECT int_stop WITH on_request;
        IPers ROS_stop_asked, int_stop;
        IDelete int_check;
        CONNECT int_check WITH on_request;
        IPers ROS_check_asked, int_check;
        IDelete int_control;
        CONNECT int_control WITH on_request;
        IPers ROS_control_asked, int_control;
        IDelete int_pause;
        CONNECT int_pause WITH on_request;
        IPers ROS_pause_asked, int_pause;
        WHILE TRUE DO
            ! A trap must not come between a test here and the reaction to it.
            IDisable;
            check_servers;
            answer_requests;
            check_conditions;
            check_builds;
            IF ROS_stop_latched release_stop;
            ROS_not_ready := blocker();
            update_alive_count;
            IEnable;
            WaitTime ROS_ALIVE_PERIOD;
        ENDWHILE
    ENDPROC

    ! Without its server a port does not answer, not even to STOP. Therefore nothing moves without all
    ! servers.
    LOCAL PROC check_servers()
        server_ended := FALSE;
        check_server ROS_alive_count_motion_server, 1, "T_ROS_RECV";
        check_server ROS_alive_count_control, 2, "T_ROS_CONTROL";
        check_server ROS_alive_count_state, 3, "T_ROS_STATE";
        IF server_ended AND is_under_way() halt ROS_REASON_TASK_ENDED;
    ENDPROC

    LOCAL PROC check_server(num value, num server, string name)
        VAR bool was_reported;

        was_reported := ended_reported{server};
        ended_reported{server} := ROS_has_ended(value, last_alive_count{server}, unchanged_checks{server},
            ROS_MAX_SEND_CHECKS);
        IF NOT ended_reported{server} RETURN;
        server_ended := TRUE;
        IF NOT was_reported ROS_report_ended_task name;
    ENDPROC

    LOCAL TRAP on_request
        answer_requests;
    ENDTRAP

    ! Answer the requests of the servers. Several requests may trigger only one interrupt, so the
    ! counters are compared. Stops come first.
    LOCAL PROC answer_requests()
        VAR num asked;

        asked := ROS_stop_asked;
        IF asked <> ROS_stop_done THEN
            execute_request ROS_stop_reason;
            ROS_not_ready := blocker();
            ROS_stop_done := asked;
        ENDIF
        asked := ROS_control_asked;
        IF asked <> ROS_control_done THEN
            execute_request ROS_control_reason;
            ROS_not_ready := blocker();
            ROS_control_done := asked;
        ENDIF
        asked := ROS_pause_asked;
        IF asked <> ROS_pause_done THEN
            IF ROS_pause_on THEN
                ROS_pause_refused := pause();
            ELSE
                ROS_pause_refused := resume();
            ENDIF
            ROS_pause_done := asked;
        ENDIF
        asked := ROS_check_asked;
        IF asked <> ROS_check_done THEN
            IF ROS_stop_latched release_stop;
            ROS_not_ready := blocker();
            ROS_check_done := asked;
        ENDIF
    ENDPROC

    ! Halt the robot on request. Moves of a program outside ROS_run do not belong to the driver.
    LOCAL PROC execute_request(num reason)
        IF ROS_is_active() OR ROS_stop_latched OR IsStopMoveAct(\FromNonMoveTask) THEN
            halt reason;
        ELSEIF ROS_run_state = ROS_RUN_OUTSIDE AND reason = ROS_REASON_STOPPED
            AND ROS_executing() <> ROS_TRI_FALSE THEN
            ErrWrite \W, "ROS: STOP is not for this program", "It is not in ROS_run: its own moves continue.";
        ENDIF
    ENDPROC

    ! End a motion that must not continue.
    LOCAL PROC check_conditions()
        VAR num reason;

        reason := ROS_stop_cause(ROS_REASON_NONE);
        IF reason = ROS_REASON_NONE THEN
            IF OpMode() <> mode reason := ROS_REASON_MODE_CHANGED;
            IF ROS_executing() = ROS_TRI_FALSE reason := ROS_REASON_PROGRAM_STOPPED;
        ENDIF
        mode := OpMode();
        IF reason > 0 THEN
            ! A trajectory that is being received at this time must not start later.
            ROS_blocker_code := reason;
            ROS_blocked := ROS_trajectory;
            IF is_under_way() halt reason;
        ENDIF
        IF ROS_interruptions_seen <> ROS_interruptions THEN
            ROS_interruptions_seen := ROS_interruptions;
            halt ROS_REASON_PROGRAM_STOPPED;
        ENDIF
        ! The paused trajectory has ended by itself, so the pause is over.
        IF ROS_paused_trajectory >= 0 AND (NOT ROS_is_active()) halt ROS_REASON_STOPPED;
    ENDPROC

    ! Return TRUE while a trajectory is active that was not halted.
    LOCAL FUNC bool is_under_way()
        RETURN ROS_is_active() AND ROS_halted_trajectory <> ROS_active_trajectory;
    ENDFUNC

    ! Write an event when tasks of different builds have been running for MAX_MIXED_ROUNDS rounds.
    LOCAL PROC check_builds()
        IF ROS_get_build_fault() <> ROS_REASON_BUILD_MISMATCH THEN
            mixed_rounds := 0;
            RETURN;
        ENDIF
        mixed_rounds := mixed_rounds + 1;
        IF mixed_rounds = MAX_MIXED_ROUNDS ErrWrite "ROS: tasks of different builds", "No trajectory is accepted."
            \RL2:="Load all modules of one build and restart.";
    ENDPROC

    LOCAL PROC halt(num reason)
        VAR bool is_client_lost := FALSE;

        stop_robot;
        ROS_stop_latched := TRUE;
        is_reported := FALSE;
        wakeups := 0;
        IF is_under_way() THEN
            ! The first reason counts.
            ROS_halt_reason := reason;
            ROS_halted_trajectory := ROS_active_trajectory;
            is_client_lost := (reason = ROS_REASON_CLIENT_LOST);
        ENDIF
        ROS_paused_trajectory := -1;
        ROS_abort := ROS_next_count(ROS_abort);
        ROS_start_clock clock_halt;
        wake_motion_task;
        ! Other stop reasons (emergency stop, mode) are visible to the operator, so they are not logged.
        IF is_client_lost ErrWrite \W, "ROS: trajectory ended early", ROS_reason_text(reason);
    ENDPROC

    ! Let the robot move again after the old path was dropped. The motion task has confirmed this, or
    ! its program was restarted and is outside ROS_run. On some controllers a stop by a server belongs
    ! to that server, and then it stays in force.
    LOCAL PROC release_stop()
        IF ROS_abort_done = ROS_abort OR (ROS_run_state = ROS_RUN_OUTSIDE AND (NOT ROS_is_active())) THEN
            IF ROS_executing() = ROS_TRI_FALSE OR ROS_motors_on() = ROS_TRI_FALSE RETURN;
            ROS_alive_count := -1;
            ROS_start_robot IsStopMoveAct(\FromNonMoveTask);
            update_alive_count;
            IF NOT IsStopMoveAct(\FromNonMoveTask) THEN
                ROS_stop_latched := FALSE;
            ELSEIF ROS_off_path THEN
                report "ROS: the robot stays stopped", "It stands too far from the path that it left.";
            ELSE
                report "ROS: the robot stays stopped", "Its stop cannot be reset.";
            ENDIF
            RETURN;
        ENDIF
        IF ROS_executing() = ROS_TRI_FALSE THEN
            ! A stopped program can neither answer nor execute an interrupt. The time-out starts when it
            ! runs, and so does one more wake-up.
            ROS_start_clock clock_halt;
            IF wakeups >= MAX_WAKEUPS wakeups := MAX_WAKEUPS - 1;
            RETURN;
        ENDIF
        IF IsStopMoveAct(\FromMoveTask) AND ROS_motors_on() <> ROS_TRI_FALSE THEN
            report "ROS: the robot stays stopped", "The motion task cannot reset its stop.";
        ELSE
            report "ROS: the motion task does not answer", "The robot stays stopped.";
        ENDIF
        IF wakeups < MAX_WAKEUPS AND ROS_elapsed_seconds(clock_wakeup) > WAKEUP_PERIOD wake_motion_task;
    ENDPROC

    ! Report a problem once, if the program has been running for REPORT_DELAY since the halt.
    LOCAL PROC report(string title, string text)
        IF is_reported RETURN;
        IF ClkRead(clock_halt) <= REPORT_DELAY RETURN;
        ErrWrite \W, title, text \RL2:="Start the program of T_ROB1 from main.";
        is_reported := TRUE;
    ENDPROC

    ! Stop the robot on its path and keep the path. Return 0 or the reason for the failure.
    LOCAL FUNC num pause()
        IF NOT is_under_way() RETURN ROS_REASON_IDLE;
        stop_robot;
        IF NOT IsStopMoveAct(\FromNonMoveTask) RETURN ROS_REASON_INTERNAL;
        ROS_paused_trajectory := ROS_active_trajectory;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! Resume a paused motion, unless an event has occurred after which it must not continue. Return 0 or
    ! the reason for the failure.
    LOCAL FUNC num resume()
        IF NOT is_under_way() RETURN ROS_REASON_IDLE;
        check_conditions;
        IF NOT is_under_way() RETURN ROS_halt_reason;
        IF ROS_paused_trajectory < 0 RETURN ROS_REASON_NONE;
        IF is_stop_asked() RETURN ROS_REASON_STOPPED;
        IF NOT start_move() RETURN ROS_REASON_INTERNAL;
        ROS_paused_trajectory := -1;
        ! StartMove has reset a stop that was requested meanwhile. That request is answered next.
        IF is_stop_asked() stop_robot;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    LOCAL FUNC bool is_stop_asked()
        RETURN ROS_stop_asked <> ROS_stop_done OR ROS_control_asked <> ROS_control_done;
    ENDFUNC

    ! Return 0 if a trajectory may start, the reason against it, or -1 if a halt is in progress.
    LOCAL FUNC num blocker()
        VAR num fault;
        VAR num reason;

        fault := ROS_get_build_fault();
        IF fault = ROS_REASON_BUILD_MISMATCH RETURN fault;
        IF server_ended RETURN ROS_REASON_TASK_ENDED;
        reason := ROS_stop_cause(fault);
        IF reason = ROS_REASON_NOT_EXECUTING AND ROS_executing() = ROS_TRI_TRUE AND ROS_run_state = ROS_RUN_OUTSIDE
            RETURN ROS_REASON_NOT_SERVING;
        IF reason <> ROS_REASON_NONE RETURN reason;
        IF ROS_executing() = ROS_TRI_FALSE RETURN ROS_REASON_NOT_EXECUTING;
        IF ROS_run_state <> ROS_RUN_SERVING RETURN ROS_REASON_NOT_SERVING;
        IF ROS_stop_latched OR ROS_paused_trajectory >= 0 RETURN -1;
        IF ROS_interruptions_seen <> ROS_interruptions RETURN -1;
        IF ROS_program_stops_seen <> ROS_program_stops RETURN -1;
        IF ROS_control_stops_seen <> ROS_control_asked RETURN -1;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! On some controllers StopMove returns only when the robot stands. The alive count is -1 meanwhile.
    LOCAL PROC stop_robot()
        ROS_alive_count := -1;
        ROS_stop_robot;
        update_alive_count;
    ENDPROC

    LOCAL PROC update_alive_count()
        alive_count := ROS_next_count(alive_count);
        ROS_alive_count := alive_count;
    ENDPROC

    LOCAL PROC wake_motion_task()
        wakeups := wakeups + 1;
        ROS_start_clock clock_wakeup;
        ROS_wakeup := ROS_next_count(ROS_wakeup);
    ENDPROC

    ! Reset the stop on the path. Return FALSE if this is not possible now (motors off, program
    ! stopped); the stop then stays in force.
    LOCAL FUNC bool start_move()
        IF IsStopMoveAct(\FromNonMoveTask) StartMove;
        RETURN TRUE;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC
ENDMODULE
