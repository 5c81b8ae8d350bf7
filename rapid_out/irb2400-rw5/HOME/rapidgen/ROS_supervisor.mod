MODULE ROS_supervisor
    ! The supervisor: stops the robot, and is the only one that starts it again.
    !
    ! Robot "irb2400-rw5", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! A halt: StopMove, which stays in force (latched); then the motion task is asked to drop
    ! its path; when it has, StartMove on the empty path. Whatever goes wrong on the way leaves
    ! the robot standing. It halts on request, and when something happened after
    ! which an old path must not go on: e-stop, motors off, program stop, change of mode.
    ! A pause: StopMove alone, so that the path is kept, and StartMove when it is asked for.

    CONST string ROS_BUILD_SUPERVISOR := "8a237425283c";

    LOCAL VAR intnum asked_to_stop;
    LOCAL VAR intnum asked_to_look;
    LOCAL VAR intnum asked_by_control;
    LOCAL VAR intnum asked_to_pause;
    LOCAL VAR num mode := 0;
    LOCAL VAR clock since_bell;
    LOCAL VAR clock since_halt;
    ! Bells since the halt, and how many of them at most: a program that does not hear them
    ! would end with too many of them waiting.
    LOCAL VAR num bells := 0;
    LOCAL CONST num MOST_BELLS := 12;
    ! Of each server: its pulse as it was read last, for how many looks it has not changed, and whether its
    ! end was reported. Servers may begin later than this task: two seconds are allowed.
    LOCAL VAR num seen{3};
    LOCAL VAR num looks{3} := [-20,-20,-20];
    LOCAL VAR bool told_ended{3};
    LOCAL VAR bool server_ended := FALSE;
    LOCAL VAR num beats := 0;
    ! It was said why the robot stays stopped.
    LOCAL VAR bool told := FALSE;
    ! Rounds for which the tasks have shown different builds.
    LOCAL VAR num rounds_mixed := 0;

    PROC main()
        ROS_start_task ROS_shown_supervisor, ROS_BUILD_SUPERVISOR = ROS_BUILD_ID;
        ! A halt from before a power failure may not be over: the motion task is asked again.
        ROS_start_clock since_bell;
        ROS_start_clock since_halt;
        ! What was under way when this task ended is over.
        IF ROS_active() OR (ROS_paused >= 0 AND IsStopMoveAct(\FromNonMoveTask)) halt ROS_REASON_POWER_FAILURE;
        ! A controller that has just been given the driver says 0, which would be a pause.
        ROS_paused := -1;
        mode := OpMode();
        IDelete asked_to_stop;
        CONNECT asked_to_stop WITH on_request;
        IPers ROS_stop_asked, asked_to_stop;
        IDelete asked_to_look;
        CONNECT asked_to_look WITH on_request;
        IPers ROS_look_asked, asked_to_look;
        IDelete asked_by_control;
        CONNECT asked_by_control WITH on_request;
        IPers ROS_control_asked, asked_by_control;
        IDelete asked_to_pause;
        CONNECT asked_to_pause WITH on_request;
        IPers ROS_pause_asked, asked_to_pause;
        WHILE TRUE DO
            ! A trap must not come between a test here and what follows from it.
            IDisable;
            watch_servers;
            answer;
            watch;
            watch_builds;
            IF ROS_latched release;
            ROS_not_ready := obstacle();
            show_pulse;
            IEnable;
            WaitTime 0.1;
        ENDWHILE
    ENDPROC

    ! A server that has ended takes its port with it, and with that a STOP: nothing moves without all of
    ! them.
    LOCAL PROC watch_servers()
        server_ended := FALSE;
        watch_server ROS_pulse_motion_server, 1, "T_ROS_RECV";
        watch_server ROS_pulse_control, 2, "T_ROS_CONTROL";
        watch_server ROS_pulse_state, 3, "T_ROS_STATE";
        IF server_ended AND under_way() halt ROS_REASON_TASK_ENDED;
    ENDPROC

    LOCAL PROC watch_server(num pulse, num n, string name)
        VAR bool ended_before;

        ended_before := told_ended{n};
        told_ended{n} := ROS_has_ended(pulse, seen{n}, looks{n}, ROS_LONGEST_SEND);
        IF NOT told_ended{n} RETURN;
        server_ended := TRUE;
        IF NOT ended_before ROS_tell_ended name;
    ENDPROC

    LOCAL TRAP on_request
        answer;
    ENDTRAP

    ! Answer requests of the servers. Interrupts of quick requests may fall into one, so the
    ! counters are compared, not the interrupts counted. Stops come first.
    LOCAL PROC answer()
        VAR num asked;

        asked := ROS_stop_asked;
        IF asked <> ROS_stop_done THEN
            carry_out ROS_stop_reason;
            ROS_not_ready := obstacle();
            ROS_stop_done := asked;
        ENDIF
        asked := ROS_control_asked;
        IF asked <> ROS_control_done THEN
            carry_out ROS_control_reason;
            ROS_not_ready := obstacle();
            ROS_control_done := asked;
        ENDIF
        asked := ROS_pause_asked;
        IF asked <> ROS_pause_done THEN
            IF ROS_pause_wanted THEN
                ROS_pause_refused := pause();
            ELSE
                ROS_pause_refused := go_on();
            ENDIF
            ROS_pause_done := asked;
        ENDIF
        asked := ROS_look_asked;
        IF asked <> ROS_look_done THEN
            IF ROS_latched release;
            ROS_not_ready := obstacle();
            ROS_look_done := asked;
        ENDIF
    ENDPROC

    ! Somebody wants a halt. The moves of a program that is not in ROS_run are its own.
    LOCAL PROC carry_out(num reason)
        IF ROS_active() OR ROS_latched OR IsStopMoveAct(\FromNonMoveTask) THEN
            halt reason;
        ELSEIF ROS_service = ROS_OUTSIDE AND reason = ROS_REASON_STOPPED AND ROS_executing() <> ROS_TRI_FALSE THEN
            ErrWrite \W, "ROS: STOP is not for this program", "It is not in ROS_run: its own moves go on.";
        ENDIF
    ENDPROC

    ! End what is under way when it must not go on by itself.
    LOCAL PROC watch()
        VAR num reason;

        reason := ROS_cause(ROS_REASON_NONE);
        IF reason = ROS_REASON_NONE THEN
            IF OpMode() <> mode reason := ROS_REASON_MODE_CHANGED;
            IF ROS_executing() = ROS_TRI_FALSE reason := ROS_REASON_PROGRAM_STOPPED;
        ENDIF
        mode := OpMode();
        IF reason > 0 THEN
            ! What is being received now does not move later, either.
            ROS_hindrance := reason;
            ROS_hindered := ROS_trajectory;
            IF under_way() halt reason;
        ENDIF
        IF ROS_interrupts_seen <> ROS_interrupts THEN
            ROS_interrupts_seen := ROS_interrupts;
            halt ROS_REASON_PROGRAM_STOPPED;
        ENDIF
        ! The paused trajectory has ended by itself: nothing is left to be paused.
        IF ROS_paused >= 0 AND (NOT ROS_active()) halt ROS_REASON_STOPPED;
    ENDPROC

    ! TRUE while there is a trajectory that was not halted.
    LOCAL FUNC bool under_way()
        RETURN ROS_active() AND ROS_halted <> ROS_session;
    ENDFUNC

    ! Say so when tasks of different builds have run side by side for two seconds.
    LOCAL PROC watch_builds()
        IF ROS_build_fault() <> ROS_REASON_BUILD_MISMATCH THEN
            rounds_mixed := 0;
            RETURN;
        ENDIF
        rounds_mixed := rounds_mixed + 1;
        IF rounds_mixed = 20 ErrWrite "ROS: tasks of different builds", "No trajectory is taken."
            \RL2:="Load all modules of one build and restart.";
    ENDPROC

    LOCAL PROC halt(num reason)
        VAR bool lost := FALSE;

        stop_robot;
        ROS_latched := TRUE;
        told := FALSE;
        bells := 0;
        IF under_way() THEN
            ! The first reason counts.
            ROS_halt_reason := reason;
            ROS_halted := ROS_session;
            lost := (reason = ROS_REASON_CLIENT_LOST);
        ENDIF
        ROS_paused := -1;
        ROS_abort := ROS_next(ROS_abort);
        ROS_start_clock since_halt;
        ring;
        ! Whoever stands beside the robot learns of all other reasons in another way.
        IF lost ErrWrite \W, "ROS: trajectory ended early", ROS_reason_text(reason);
    ENDPROC

    ! Let the robot move again, once nothing is left of the old path: the program says so, or was begun
    ! anew and is not in ROS_run, where nothing of ours may hold its moves. A stop by a server may be
    ! that task's own on some controllers: then it stays.
    LOCAL PROC release()
        IF ROS_abort_done = ROS_abort OR (ROS_service = ROS_OUTSIDE AND (NOT ROS_active())) THEN
            IF ROS_executing() = ROS_TRI_FALSE OR ROS_motors_on() = ROS_TRI_FALSE RETURN;
            ROS_pulse := -1;
            ROS_start_robot IsStopMoveAct(\FromNonMoveTask);
            show_pulse;
            IF NOT IsStopMoveAct(\FromNonMoveTask) THEN
                ROS_latched := FALSE;
            ELSEIF ROS_far_off THEN
                tell "ROS: the robot stays stopped", "It stands too far from the path that it left.";
            ELSE
                tell "ROS: the robot stays stopped", "Its stop cannot be taken back.";
            ENDIF
            RETURN;
        ENDIF
        IF ROS_executing() = ROS_TRI_FALSE THEN
            ! It cannot answer, nor hear a bell: the time for that begins when it runs, and with one more.
            ROS_start_clock since_halt;
            IF bells >= MOST_BELLS bells := MOST_BELLS - 1;
            RETURN;
        ENDIF
        IF IsStopMoveAct(\FromMoveTask) AND ROS_motors_on() <> ROS_TRI_FALSE THEN
            tell "ROS: the robot stays stopped", "The motion task cannot take back its stop.";
        ELSE
            tell "ROS: the motion task does not answer", "The robot stays stopped.";
        ENDIF
        IF bells < MOST_BELLS AND ROS_elapsed(since_bell) > 0.25 ring;
    ENDPROC

    ! Say once what is wrong, when the program has run for two seconds since the halt.
    LOCAL PROC tell(string title, string what)
        IF told RETURN;
        IF ClkRead(since_halt) <= 2 RETURN;
        ErrWrite \W, title, what \RL2:="Start the program of T_ROB1 from main.";
        told := TRUE;
    ENDPROC

    ! Stop the robot on its path and keep that. Gives why not, 0: done.
    LOCAL FUNC num pause()
        IF NOT under_way() RETURN ROS_REASON_IDLE;
        stop_robot;
        IF NOT IsStopMoveAct(\FromNonMoveTask) RETURN ROS_REASON_INTERNAL;
        ROS_paused := ROS_session;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! Let a paused robot go on along its path, unless something has happened after which it
    ! must not. Gives why not, 0: done.
    LOCAL FUNC num go_on()
        IF NOT under_way() RETURN ROS_REASON_IDLE;
        watch;
        IF NOT under_way() RETURN ROS_halt_reason;
        IF ROS_paused < 0 RETURN ROS_REASON_NONE;
        IF stop_asked() RETURN ROS_REASON_STOPPED;
        IF NOT started() RETURN ROS_REASON_INTERNAL;
        ROS_paused := -1;
        ! A stop that came meanwhile is answered next, but this has taken it back.
        IF stop_asked() stop_robot;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    LOCAL FUNC bool stop_asked()
        RETURN ROS_stop_asked <> ROS_stop_done OR ROS_control_asked <> ROS_control_done;
    ENDFUNC

    ! 0, why no trajectory may start, or -1: not yet.
    LOCAL FUNC num obstacle()
        VAR num fault;
        VAR num reason;

        fault := ROS_build_fault();
        IF fault = ROS_REASON_BUILD_MISMATCH RETURN fault;
        IF server_ended RETURN ROS_REASON_TASK_ENDED;
        reason := ROS_cause(fault);
        IF reason = ROS_REASON_NOT_EXECUTING AND ROS_executing() = ROS_TRI_TRUE AND ROS_service = ROS_OUTSIDE
            RETURN ROS_REASON_NOT_SERVING;
        IF reason <> ROS_REASON_NONE RETURN reason;
        IF ROS_executing() = ROS_TRI_FALSE RETURN ROS_REASON_NOT_EXECUTING;
        IF ROS_service <> ROS_SERVING RETURN ROS_REASON_NOT_SERVING;
        IF ROS_latched OR ROS_paused >= 0 RETURN -1;
        IF ROS_interrupts_seen <> ROS_interrupts RETURN -1;
        IF ROS_stops_seen <> ROS_program_stops RETURN -1;
        IF ROS_control_seen <> ROS_control_asked RETURN -1;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    ! Some controllers go on behind StopMove only when the robot stands: no pulse is shown meanwhile.
    LOCAL PROC stop_robot()
        ROS_pulse := -1;
        ROS_stop_robot;
        show_pulse;
    ENDPROC

    LOCAL PROC show_pulse()
        beats := ROS_next(beats);
        ROS_pulse := beats;
    ENDPROC

    LOCAL PROC ring()
        bells := bells + 1;
        ROS_start_clock since_bell;
        ROS_bell := ROS_next(ROS_bell);
    ENDPROC

    ! Take back the stop on a path. FALSE: not now (motors off, program stopped), it stays in force.
    LOCAL FUNC bool started()
        IF IsStopMoveAct(\FromNonMoveTask) StartMove;
        RETURN TRUE;
    ERROR
        SkipWarn;
        RETURN FALSE;
    ENDFUNC
ENDMODULE
