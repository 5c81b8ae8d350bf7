MODULE raise_in_handler
! source: public modules that run on controllers (ABB's StateMachine add-in, Keyence's CV-X) raise a
! number in a handler [code]; [K §4.8] forbids it: a switch
  CONST errnum other := 7;
  PROC main()
    middle;
    TPWrite "next";
    ! expect: inner
    ! expect: middle got 7
    ! expect: main got 8
    ! expect: next
    far;
    TPWrite "end";
    ! expect: point got 9
    ! expect: end
  ERROR
    TPWrite "main got " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
  ERROR
    TPWrite "middle got " + ValToStr(ERRNO);
    RAISE 8;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "inner";
    RAISE other;
  ENDPROC
  PROC far()
    between;
  ERROR (9)
    TPWrite "point got " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC between()
    VAR num z;
    thrower;
  ERROR
    TPWrite "never: the long jump passes it";
    RAISE;
  ENDPROC
  PROC thrower()
    VAR num z;
    z := 1 / z;
  ERROR
    IF ERRNO = ERR_DIVZERO RAISE 9;
    RAISE;
  ENDPROC
ENDMODULE
