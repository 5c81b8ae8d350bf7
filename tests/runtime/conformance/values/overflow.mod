MODULE overflow
! source: [K §1.4, 2.13] a num does not go beyond IEEE single; ERR_NUM_LIMIT [mem]
  PROC main()
    VAR num x := 1E38;
    VAR num n := 0;
    x := x * 10;
    TPWrite ValToStr(x);
    WHILE n < 5 DO
      x := x + x;
      Incr n;
    ENDWHILE
    TPWrite "end";
    ! expect: limit
    ! expect: 1E+38
    ! expect: limit
    ! expect: limit
    ! expect: limit
    ! expect: limit
    ! expect: end
  ERROR
    IF ERRNO = ERR_NUM_LIMIT TPWrite "limit";
    TRYNEXT;
  ENDPROC
ENDMODULE
