MODULE retry_limit
! source: [K §7.5] four retries; [S4 datasys 2-IODisable-2] the handler may then see ERR_EXCRTYMAX
  VAR num tries := 0;
  PROC main()
    VAR num q;
    q := divide(0);
    TPWrite ValToStr(q) + " after " + ValToStr(tries);
    ! expect: -1 after 5
    forever;
    ! expect: 4 3 2 1 0
  ENDPROC
  FUNC num divide(num d)
    Incr tries;
    Decr tries;
    RETURN count() / d;
  ERROR
    IF ERRNO = ERR_EXCRTYMAX RETURN -1;
    RETRY;
  ENDFUNC
  FUNC num count()
    Incr tries;
    RETURN 1;
  ENDFUNC
  PROC forever()
    VAR num z;
    VAR string left;
    z := 1 / z;
  ERROR
    left := left + ValToStr(RemainingRetries());
    IF RemainingRetries() > 0 THEN
      left := left + " ";
      RETRY;
    ENDIF
    TPWrite left;
    TRYNEXT;
  ENDPROC
ENDMODULE
