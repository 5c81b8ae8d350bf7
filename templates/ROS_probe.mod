MODULE ROS_probe
    ! Questions to a controller, about what no manual settles. Load this module alone into a
    ! NORMAL task, PP to main, Start, and read the pendant (or the event log, 80003). Each line
    ! is an answer, `switch=value`, as `rapidgen run --dialect` and the test suite take it.
    !
    ! Nothing here moves a robot, sets an output or opens a socket. The last question may stop
    ! the program: then its answer is `unhandled_error=stop`.

    LOCAL VAR intnum alarm;
    LOCAL PERS bool rung := FALSE;
    LOCAL VAR clock watch;

    PROC main()
        ask_num_rounding;
        ask_for_loop;
        ask_integer_division;
        ask_negative_mod;
        ask_wait_until;
        tell_statement_time;
        ask_unhandled_error;
    ENDPROC

    LOCAL PROC answer(string line)
        TPWrite line;
        ErrWrite \I, "ROS probe", line;
    ENDPROC

    ! Is a num rounded between the operators of one expression?
    LOCAL PROC ask_num_rounding()
        VAR num large := 16777216;
        VAR num small := 0.25;
        VAR num left;

        left := large + small - large;
        IF left = 0.25 THEN
            answer "num_rounding=store";
        ELSE
            answer "num_rounding=operation";
        ENDIF
    ENDPROC

    ! Does FOR count down by itself, and run at least once?
    LOCAL PROC ask_for_loop()
        VAR num passes := 0;

        FOR i FROM 1 TO 0 DO
            passes := passes + 1;
        ENDFOR
        IF passes = 2 THEN
            answer "for_loop=kernel";
        ELSEIF passes = 0 THEN
            answer "for_loop=tested";
        ELSE
            answer "! FOR i FROM 1 TO 0 made " + ValToStr(passes) + " passes";
        ENDIF
    ENDPROC

    ! How is a negative quotient cut?
    LOCAL PROC ask_integer_division()
        VAR num seven := -7;

        IF seven DIV 2 = -3 THEN
            answer "integer_division=truncate";
        ELSE
            answer "integer_division=floor";
        ENDIF
    ENDPROC

    ! May the left operand of MOD be negative?
    LOCAL PROC ask_negative_mod()
        VAR num seven := -7;
        VAR num rest;

        rest := seven MOD 3;
        IF rest < 3 answer "negative_mod=allow";
    ERROR
        SkipWarn;
        answer "negative_mod=error";
        RETURN;
    ENDPROC

    ! Is WaitUntil woken by a change, or does it look every 100 ms?
    LOCAL PROC ask_wait_until()
        VAR num waited;

        rung := FALSE;
        IDelete alarm;
        CONNECT alarm WITH on_alarm;
        ClkReset watch;
        ClkStart watch;
        ITimer \Single, 0.02, alarm;
        WaitUntil rung;
        waited := ClkRead(watch);
        ClkStop watch;
        IDelete alarm;
        IF waited < 0.08 THEN
            answer "wait_until=event";
        ELSE
            answer "wait_until=polled";
        ENDIF
    ENDPROC

    LOCAL TRAP on_alarm
        rung := TRUE;
    ENDTRAP

    ! What a statement costs here, for the cost model.
    LOCAL PROC tell_statement_time()
        VAR num sum := 0;
        VAR num count := 20000;

        ClkReset watch;
        ClkStart watch;
        FOR i FROM 1 TO count DO
            sum := sum + 1;
        ENDFOR
        ClkStop watch;
        answer "! microseconds a pass: " + NumToStr(1000000 * ClkRead(watch) / count, 2);
    ENDPROC

    ! Does an error reach the caller through a routine without a handler?
    LOCAL PROC ask_unhandled_error()
        answer "! If the program stops now: unhandled_error=stop";
        without_handler;
    ERROR
        SkipWarn;
        answer "unhandled_error=propagate";
        RETURN;
    ENDPROC

    LOCAL PROC without_handler()
        VAR num zero := 0;

        zero := 1 / zero;
    ENDPROC
ENDMODULE
