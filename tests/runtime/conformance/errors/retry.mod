MODULE retry_shown
! source: [K §4.10, 7.1] RETRY repeats the failing statement, and only that
  PROC main()
    VAR num d := 0;
    VAR num before := 0;
    VAR num q;
    Incr before;
    q := 10 / d;
    TPWrite ValToStr(q) + " " + ValToStr(before);
    ! expect: 5 1
  ERROR
    d := d + 2;
    RETRY;
  ENDPROC
ENDMODULE
