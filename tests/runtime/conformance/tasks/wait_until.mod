MODULE wait_until_shown
! source: [S4 datasys 2-WaitUntil-1] looked at once, then every 100 ms; \MaxTime, \TimeFlag
! task: T_TWO second
  PERS bool pulse := FALSE;
  PERS bool go := FALSE;
  PROC main()
    VAR bool late;
    WaitUntil pulse \MaxTime:=1 \TimeFlag:=late;
    TPWrite "short pulse seen " + ValToStr(NOT late);
    ! expect: short pulse seen FALSE
    WaitUntil go \MaxTime:=10 \TimeFlag:=late;
    TPWrite ValToStr(late);
    ! expect: FALSE
    WaitUntil FALSE \MaxTime:=0.5;
    TPWrite "end";
    ! expect: MAXTIME
    ! expect: end
  ERROR
    IF ERRNO = ERR_WAIT_MAXTIME TPWrite "MAXTIME";
    TRYNEXT;
  ENDPROC
  PROC second()
    WaitTime 0.31;
    pulse := TRUE;
    WaitTime 0.01;
    pulse := FALSE;
    WaitTime 2;
    go := TRUE;
  ENDPROC
ENDMODULE
