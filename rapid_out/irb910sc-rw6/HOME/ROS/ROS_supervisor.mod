MODULE ROS_supervisor
    ! The supervisor: the only task but the motion task that stops the robot.
    !
    ! Robot "irb910sc-rw6", motion group rob1, T_ROB1. Written by rapidgen 0.1.0.
    ! Do not edit: change the configuration and build again. Modules of different
    ! builds take no trajectory.
    !
    ! A halt: StopMove, which stays in force (latched); then the motion task is asked to drop
    ! its path; when it has, StartMove on the empty path. Whatever goes wrong on the way leaves
    ! the robot standing. It halts on request, and when something happened after
    ! which an old path must not go on: e-stop, motors off, program stop, change of mode.

    CONST string ROS_BUILD_SUPERVISOR := "82dda9b25aaf";

    LOCAL VAR intnum asked_to_stop;
    LOCAL VAR intnum asked_to_look;
    LOCAL VAR num mode := 0;
    LOCAL VAR clock since_bell;
    LOCAL VAR clock since_halt;
    ! It was said that the motion task does not answer.
    LOCAL VAR bool told := FALSE;
    ! Rounds for which the tasks have shown different builds.
    LOCAL VAR num rounds_mixed := 0;

    PROC main()
        ROS_start_task ROS_shown_supervisor, ROS_BUILD_SUPERVISOR;
        ! What was under way when this task ended is over.
        IF ROS_active() halt ROS_REASON_POWER_FAILURE;
        mode := OpMode();
        IDelete asked_to_stop;
        CONNECT asked_to_stop WITH on_request;
        IPers ROS_stop_asked, asked_to_stop;
        IDelete asked_to_look;
        CONNECT asked_to_look WITH on_request;
        IPers ROS_look_asked, asked_to_look;
        WHILE TRUE DO
            ! A trap must not come between a test here and what follows from it.
            IDisable;
            answer;
            watch;
            watch_builds;
            IF ROS_latched release;
            ROS_not_ready := obstacle();
            IEnable;
            WaitTime 0.1;
        ENDWHILE
    ENDPROC

    LOCAL TRAP on_request
        answer;
    ENDTRAP

    ! Answer requests of the motion server. Interrupts of quick requests may fall into one, so
    ! the counters are compared, not the interrupts counted.
    LOCAL PROC answer()
        VAR num asked;

        asked := ROS_stop_asked;
        IF asked <> ROS_stop_done THEN
            halt ROS_stop_reason;
            ROS_not_ready := obstacle();
            ROS_stop_done := asked;
        ENDIF
        asked := ROS_look_asked;
        IF asked <> ROS_look_done THEN
            IF ROS_latched release;
            ROS_not_ready := obstacle();
            ROS_look_done := asked;
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
        IF reason > 0 AND ROS_active() AND ROS_halted <> ROS_session halt reason;
        IF ROS_interrupts_seen <> ROS_interrupts THEN
            ROS_interrupts_seen := ROS_interrupts;
            halt ROS_REASON_PROGRAM_STOPPED;
        ENDIF
    ENDPROC

    ! Say so when tasks of different builds have run side by side for two seconds. Before the
    ! program runs, the motion task shows the build of its last run.
    LOCAL PROC watch_builds()
        IF ROS_same_build() OR ROS_executing() = ROS_TRI_FALSE THEN
            rounds_mixed := 0;
            RETURN;
        ENDIF
        rounds_mixed := rounds_mixed + 1;
        IF rounds_mixed = 20 ErrWrite "ROS: tasks of different builds", "No trajectory is taken."
            \RL2:="Load all modules of one build and restart.";
    ENDPROC

    LOCAL PROC halt(num reason)
        stop_robot;
        ROS_latched := TRUE;
        told := FALSE;
        IF ROS_active() THEN
            ROS_halt_reason := reason;
            ROS_halted := ROS_session;
        ENDIF
        ROS_abort := ROS_next(ROS_abort);
        ClkReset since_halt;
        ClkStart since_halt;
        ring;
    ENDPROC

    ! Let the robot move again, once nothing is left of the old path.
    LOCAL PROC release()
        IF ROS_abort_done = ROS_abort THEN
            IF ROS_executing() = ROS_TRI_FALSE OR ROS_motors_on() = ROS_TRI_FALSE RETURN;
            start_robot;
            RETURN;
        ENDIF
        IF ROS_executing() <> ROS_TRI_FALSE AND (NOT told) AND ClkRead(since_halt) > 2 THEN
            ErrWrite \W, "ROS: the motion task does not answer", "The robot stays stopped."
                \RL2:="Start the program of T_ROB1 from main.";
            told := TRUE;
        ENDIF
        IF ClkRead(since_bell) > 0.25 ring;
    ENDPROC

    ! 0, why no trajectory may start, or -1: not yet.
    LOCAL FUNC num obstacle()
        VAR num reason;

        IF NOT ROS_same_build() RETURN ROS_REASON_BUILD_MISMATCH;
        reason := ROS_cause(ROS_REASON_NONE);
        IF reason <> ROS_REASON_NONE RETURN reason;
        IF ROS_executing() = ROS_TRI_FALSE RETURN ROS_REASON_NOT_EXECUTING;
        IF ROS_latched OR ROS_interrupts_seen <> ROS_interrupts RETURN -1;
        RETURN ROS_REASON_NONE;
    ENDFUNC

    LOCAL PROC ring()
        ClkReset since_bell;
        ClkStart since_bell;
        ROS_bell := ROS_next(ROS_bell);
    ENDPROC

    LOCAL PROC stop_robot()
        StopMove;
    ERROR
        ! Nothing moves, or it is stopped already.
        SkipWarn;
        TRYNEXT;
    ENDPROC

    LOCAL PROC start_robot()
        IF IsStopMoveAct(\FromNonMoveTask) StartMove;
        ROS_latched := FALSE;
    ERROR
        ! Not now (motors off, program stopped): it stays latched and the next round tries again.
        SkipWarn;
        RETURN;
    ENDPROC
ENDMODULE
