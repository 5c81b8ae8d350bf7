MODULE wait_until_event
! source: [mem] switch wait_until=event
! dialect: wait_until=event
! task: T_TWO second
  PERS bool pulse := FALSE;
  PROC main()
    VAR bool late;
    WaitUntil pulse \MaxTime:=1 \TimeFlag:=late;
    TPWrite "short pulse seen " + ValToStr(NOT late);
    ! expect: short pulse seen TRUE
  ENDPROC
  PROC second()
    WaitTime 0.31;
    pulse := TRUE;
    WaitTime 0.01;
    pulse := FALSE;
  ENDPROC
ENDMODULE
