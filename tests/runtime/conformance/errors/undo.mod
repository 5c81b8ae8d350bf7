MODULE undo_shown
! source: [K §7.2-7.4] UNDO when the routine is aborted, not at a normal RETURN nor when a caller handles the error
! dialect: unhandled_error=propagate
! cycle: 6
  VAR num round := 0;
  PROC main()
    Incr round;
    work round;
    TPWrite "returned " + ValToStr(round);
    ! expect: returned 1
    ! expect: handled
    ! expect: returned 2
    ! expect: undo 3
    ! expect: undo 4
    IF round = 3 EXIT;
  ERROR
    TPWrite "handled";
    TRYNEXT;
  ENDPROC
  PROC work(num n)
    IF n = 2 RAISE 5;
    IF n = 3 ExitCycle;
    IF n = 4 EXIT;
    RETURN;
  UNDO
    TPWrite "undo " + ValToStr(n);
  ENDPROC
ENDMODULE
