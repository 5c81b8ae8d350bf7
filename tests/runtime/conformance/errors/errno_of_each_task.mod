MODULE errno_of_each_task
! source: [K §13.2, 14.2] ERRNO is a task's own, and keeps its value behind the handler [code]
! task: T_BACK other
  PERS bool done := FALSE;
  PROC main()
    raises 5;
    WaitUntil done;
    TPWrite ValToStr(ERRNO);
    ! expect: 6
    ! expect: 5
  ENDPROC
  PROC other()
    WaitTime 0.01;
    raises 6;
    TPWrite ValToStr(ERRNO);
    done := TRUE;
  ENDPROC
  PROC raises(num n)
    RAISE n;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
