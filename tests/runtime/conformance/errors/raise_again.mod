MODULE raise_again
! source: [K §4.8, 7.1] RAISE without a number gives the same error to the caller; ERRNO keeps its value
  PROC main()
    inner;
    TPWrite ValToStr(ERRNO = ERR_DIVZERO);
    ! expect: inner
    ! expect: main TRUE
    ! expect: TRUE
  ERROR
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "inner";
    RAISE;
  ENDPROC
ENDMODULE
