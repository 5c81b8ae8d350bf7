MODULE user
! source: [K §7.3] \BreakOff drops the routines between, whose UNDO runs; RETRY calls them anew
  VAR num calls := 0;
  PROC main()
    outer;
    TPWrite "end";
    ! expect: inner 1
    ! expect: undo
    ! expect: user 5
    ! expect: inner 2
    ! expect: undo
    ! expect: user 5
    ! expect: next
    ! expect: returned to the caller
    ! expect: undo
    ! expect: raised 7
    ! expect: end
  ENDPROC
  PROC outer()
    middle;
    TPWrite "next";
    returns;
    TPWrite "returned to the caller";
    raises;
  ERROR
    IF ERRNO = 7 THEN
      TPWrite "raised 7";
      TRYNEXT;
    ENDIF
    TPWrite "user " + ValToStr(ERRNO);
    IF calls = 1 RETRY;
    TRYNEXT;
  ENDPROC
  PROC returns()
    last;
    TPWrite "never here";
  ERROR
    RETURN;
  ENDPROC
  PROC raises()
    VAR num z;
    middle;
  ERROR
    RAISE 7;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  PROC middle()
    inner;
  ERROR
    TPWrite "never here either";
    TRYNEXT;
  UNDO
    TPWrite "undo";
  ENDPROC
  PROC inner()
    calls := calls + 1;
    IF calls < 3 TPWrite "inner " + ValToStr(calls);
    RAISE 5;
  ERROR
    RaiseToUser \BreakOff;
  ENDPROC
  PROC last()
    RAISE 6;
  ERROR
    RaiseToUser \Continue;
  ENDPROC
ENDMODULE
