MODULE user
! source: [K §7.3] RETRY and TRYNEXT of the user's handler go on where the error occurred
! dialect: unhandled_error=propagate
  VAR num tries := 0;
  PROC main()
    routine1;
    TPWrite "end";
    ! expect: routine2
    ! expect: routine3
    ! expect: user 11
    ! expect: user 11
    ! expect: divided
    ! expect: user 2
    ! expect: passed over
    ! expect: back in routine2
    ! expect: end
  ENDPROC
  PROC routine1()
    routine2;
  ERROR
    IF ERRNO = 11 OR ERRNO = 2 THEN
      TPWrite "user " + ValToStr(ERRNO);
    ELSE
      TPWrite "what?";
    ENDIF
    Incr tries;
    divisor := tries - 1;
    IF ERRNO = 11 RETRY;
    TRYNEXT;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  VAR num divisor := 0;
  PROC routine2()
    TPWrite "routine2";
    routine3;
    TPWrite "back in routine2";
  ERROR
    TPWrite "never here";
    TRYNEXT;
  ENDPROC
  PROC routine3()
    VAR num q;
    TPWrite "routine3";
    q := 1 / divisor;
    TPWrite "divided";
    helper;
    TPWrite "passed over";
  ERROR
    IF ERRNO = ERR_DIVZERO RaiseToUser \Continue \ErrorNumber:=11;
    RaiseToUser \Continue;
    TPWrite "never here either";
    TRYNEXT;
  ENDPROC
  PROC helper()
    RAISE 2;
  ENDPROC
ENDMODULE
