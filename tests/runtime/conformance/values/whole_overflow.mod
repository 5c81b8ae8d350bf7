MODULE whole_overflow
! source: [K §2.13] a num is an IEEE single, also one that has only whole values; ERR_NUM_LIMIT [mem]
  PROC main()
    VAR num n := 1;
    VAR num passes := 0;
    WHILE passes < 40 DO
      n := n * 10;
      passes := passes + 1;
    ENDWHILE
    TPWrite ValToStr(n);
    n := n + n + n + n;
    TPWrite ValToStr(n);
    n := 16777215;
    Incr n;
    Incr n;
    Incr n;
    TPWrite ValToStr(n = 16777216);
    ! expect: limit
    ! expect: limit
    ! expect: 1E+38
    ! expect: limit
    ! expect: 1E+38
    ! expect: TRUE
  ERROR
    IF ERRNO = ERR_NUM_LIMIT TPWrite "limit";
    TRYNEXT;
  ENDPROC
ENDMODULE
