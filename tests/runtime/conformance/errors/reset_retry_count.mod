MODULE reset_retry_count
! source: [manual DB] ResetRetryCount
  VAR num tries := 0;
  PROC main()
    VAR num z;
    z := 10 / z;
    TPWrite ValToStr(tries) + " " + ValToStr(z);
    ! expect: 9 10
  ERROR
    Incr tries;
    IF tries = 4 ResetRetryCount;
    IF tries >= 9 z := 1;
    IF tries = 8 ResetRetryCount;
    RETRY;
  ENDPROC
ENDMODULE
