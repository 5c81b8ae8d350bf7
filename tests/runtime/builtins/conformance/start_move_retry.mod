MODULE start_move_retry
    ! source: [manual 3HAC050917] StartMoveRetry: StartMove and RETRY in one, in an ERROR handler
    ! robot: irb120
    ! fault: 40001 13
    ! expect: try 1
    ! expect: try 2
    ! expect: TRUE FALSE
    VAR num tries := 0;
    PROC main()
        risky;
        TPWrite ValToStr(tries = 2) + " " + ValToStr(IsStopMoveAct(\FromMoveTask));
        StopMove;
        StartMoveRetry;
    ENDPROC
    PROC risky()
        attempt;
    ERROR
        StopMove;
        StartMoveRetry;
        TPWrite "not reached";
    ENDPROC
    PROC attempt()
        tries := tries + 1;
        TPWrite "try " + ValToStr(tries);
        IF tries = 1 RAISE 5;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
