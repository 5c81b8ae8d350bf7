MODULE retry_exhausted
! source: [K §7.5] retries used up and RETRY again: the task stops
! fault: ERR_EXCRTYMAX 8
  VAR num seen := 0;
  PROC main()
    VAR num z;
    TPWrite "start";
    z := 1 / z;
    ! expect: start
    ! expect: 6
  ERROR
    Incr seen;
    IF seen = 6 TPWrite ValToStr(seen);
    RETRY;
  ENDPROC
ENDMODULE
