MODULE ROS_probe_motion
    ! Questions to a controller about motion, which it can only answer by moving: THE ROBOT TURNS
    ! ITS AXIS 6 BY UP TO 10 DEGREES, slowly and back again, from where it stands. Look whether
    ! cables and tool allow that. For a robot without axis 6 change the routine `turned`.
    !
    ! Load this module alone into the task of the robot, PP to main, reduced speed in manual mode or
    ! a fenced cell, Start, and read the pendant (or the event log, 80003). Each line is an answer,
    ! `switch=value`, as rapidgen's motion model takes it (docs/rapid/motion-model.md).

    ! deg, and s for that way
    LOCAL CONST num WAY := 5;
    LOCAL CONST num SECONDS := 2;

    LOCAL VAR jointtarget start;
    LOCAL VAR jointtarget place;
    LOCAL VAR clock watch;
    LOCAL VAR num lasted := 0;
    LOCAL VAR num percent := 100;
    LOCAL VAR intnum alarm;
    LOCAL VAR intnum second_alarm;
    LOCAL VAR bool running := FALSE;
    LOCAL PERS num changes := 0;
    LOCAL VAR num traps := 0;

    PROC main()
        VAR num consent := 0;

        TPReadFK consent, "May axis 6 turn by 10 degrees?", stEmpty, stEmpty, stEmpty, "Yes", "No";
        IF consent <> 4 EXIT;
        start := CJointT();
        ask_quick_changes;
        ask_zero_length;
        ask_refresh_timed;
        ask_refresh_lasts;
        ask_refresh_standing;
        ask_velset_timed;
        tell_time_after_stop;
        tell_planning_lead;
        ask_stop_move_reset;
        ask_unreachable_target;
        ask_stop;
        go_back;
        EXIT;
    ENDPROC

    LOCAL PROC answer(string line)
        TPWrite line;
        ErrWrite \I, "ROS probe", line;
    ENDPROC

    ! Where the robot stood at first, but for axis 6.
    LOCAL FUNC jointtarget turned(num degrees)
        VAR jointtarget target;

        target := start;
        target.robax.rax_6 := target.robax.rax_6 + degrees;
        RETURN target;
    ENDFUNC

    ! Move with a stop point; s until the program goes on.
    LOCAL PROC turn(num degrees, num time)
        place := turned(degrees);
        ClkReset watch;
        ClkStart watch;
        MoveAbsJ place \NoEOffs, v100 \T:=time, fine, tool0;
        lasted := ClkRead(watch);
        ClkStop watch;
    ENDPROC

    LOCAL PROC go_back()
        turn 0, SECONDS;
    ENDPROC

    ! Are two quick changes of a persistent one interrupt or two?
    LOCAL PROC ask_quick_changes()
        IDelete alarm;
        CONNECT alarm WITH on_change;
        IPers changes, alarm;
        changes := changes + 1;
        changes := changes + 1;
        WaitTime 0.5;
        IDelete alarm;
        changes := 0;
        answer "! two quick changes of a PERS: " + ValToStr(traps) + " traps";
    ENDPROC

    LOCAL TRAP on_change
        traps := traps + 1;
    ENDTRAP

    ! Does a move to where the robot stands take its \T?
    LOCAL PROC ask_zero_length()
        turn 0, 1;
        turn 0, 1;
        IF lasted < 0.5 THEN
            answer "zero_length=skip";
        ELSE
            answer "zero_length=wait";
        ENDIF
    ENDPROC

    ! Another speed, soon: SpeedRefresh may do nothing but in a move.
    LOCAL PROC refresh_soon(num wanted)
        percent := wanted;
        IDelete alarm;
        CONNECT alarm WITH on_refresh;
        ITimer \Single, 0.1, alarm;
    ENDPROC

    LOCAL TRAP on_refresh
        SpeedRefresh percent;
    ENDTRAP

    ! To `degrees`, by WAY, without \T, in 2 s; s until the program goes on.
    LOCAL PROC turn_slowly(num degrees)
        VAR speeddata slow := [1000, 2.5, 1000, 1000];

        place := turned(degrees);
        ClkReset watch;
        ClkStart watch;
        MoveAbsJ place \NoEOffs, slow, fine, tool0;
        lasted := ClkRead(watch);
        ClkStop watch;
    ENDPROC

    LOCAL PROC full_speed_again()
        SpeedRefresh 100;
        refresh_soon 100;
        go_back;
        IDelete alarm;
    ENDPROC

    ! Does SpeedRefresh stretch a \T?
    LOCAL PROC ask_refresh_timed()
        refresh_soon 50;
        turn WAY, SECONDS;
        IF lasted > 1.5 * SECONDS THEN
            answer "refresh_timed=true";
        ELSE
            answer "refresh_timed=false";
        ENDIF
        full_speed_again;
    ENDPROC

    ! Does SpeedRefresh hold for the move behind it, too?
    LOCAL PROC ask_refresh_lasts()
        refresh_soon 50;
        turn_slowly WAY;
        turn_slowly 2 * WAY;
        IF lasted > 1.5 * SECONDS THEN
            answer "refresh_lasts=true";
        ELSE
            answer "refresh_lasts=false";
        ENDIF
        full_speed_again;
    ENDPROC

    ! Does SpeedRefresh before a move act on it?
    LOCAL PROC ask_refresh_standing()
        SpeedRefresh 50;
        turn_slowly WAY;
        IF lasted > 1.5 * SECONDS THEN
            answer "refresh_standing=true";
        ELSE
            answer "refresh_standing=false";
        ENDIF
        full_speed_again;
    ENDPROC

    ! Does VelSet stretch a \T?
    LOCAL PROC ask_velset_timed()
        VelSet 50, 5000;
        turn WAY, SECONDS;
        VelSet 100, 5000;
        IF lasted > 1.5 * SECONDS THEN
            answer "velset_timed=true";
        ELSE
            answer "velset_timed=false";
        ENDIF
        go_back;
    ENDPROC

    ! How long does a move with \T take that has stood still for 1 s on its way?
    LOCAL PROC tell_time_after_stop()
        IDelete alarm;
        CONNECT alarm WITH on_pause;
        ITimer \Single, SECONDS / 2, alarm;
        turn WAY, SECONDS;
        IDelete alarm;
        answer "! stopped for 1 s, " + ValToStr(SECONDS) + " s become " + NumToStr(lasted, 2) + " s";
        go_back;
    ENDPROC

    LOCAL TRAP on_pause
        StopMove;
        WaitTime 1;
        StartMove;
    ENDTRAP

    ! Does StopMoveReset take back a StopMove?
    LOCAL PROC ask_stop_move_reset()
        StopMove;
        StopMoveReset;
        IF IsStopMoveAct(\FromMoveTask) THEN
            answer "stop_move_reset=keeps";
            StartMove;
        ELSE
            answer "stop_move_reset=releases";
        ENDIF
    ENDPROC

    ! When does a fly-by move let the program go on?
    LOCAL PROC tell_planning_lead()
        VAR jointtarget there;

        place := turned(WAY);
        there := turned(2 * WAY);
        ClkReset watch;
        ClkStart watch;
        MoveAbsJ place \NoEOffs, v100 \T:=SECONDS, z1, tool0;
        lasted := ClkRead(watch);
        MoveAbsJ there \NoEOffs, v100 \T:=SECONDS, fine, tool0;
        answer "! a fly-by move returns " + NumToStr(SECONDS - lasted, 2) + " s before its point";
        go_back;
    ENDPROC

    ! Does StopMove wait for standstill, and does a move return when its path is gone?
    LOCAL PROC ask_stop()
        running := TRUE;
        IDelete alarm;
        CONNECT alarm WITH on_stop;
        ITimer \Single, SECONDS / 2, alarm;
        IDelete second_alarm;
        CONNECT second_alarm WITH on_hang;
        ITimer \Single, SECONDS + 8, second_alarm;
        turn WAY, SECONDS;
        running := FALSE;
        IDelete second_alarm;
        IF lasted < SECONDS + 7 answer "cleared_move=return";
        IDelete alarm;
    ENDPROC

    LOCAL TRAP on_stop
        VAR jointtarget stopping;
        VAR jointtarget standing;

        StopMove;
        stopping := CJointT();
        WaitTime 1;
        standing := CJointT();
        IF Abs(standing.robax.rax_6 - stopping.robax.rax_6) > 0.01 THEN
            answer "stop_waits=false";
        ELSE
            answer "stop_waits=true";
        ENDIF
        ClearPath;
        StartMove;
    ENDTRAP

    LOCAL TRAP on_hang
        IF NOT running RETURN;
        answer "cleared_move=hang";
        answer "! The robot stands beside its first place. This is the end.";
        EXIT;
    ENDTRAP

    ! Can a target outside the axis ranges be handled?
    LOCAL PROC ask_unreachable_target()
        place := turned(20000);
        answer "! If the program stops now: unreachable_target=stop";
        MoveAbsJ place \NoEOffs, v100, fine, tool0;
    ERROR
        SkipWarn;
        answer "unreachable_target=handler";
        RETURN;
    ENDPROC
ENDMODULE
