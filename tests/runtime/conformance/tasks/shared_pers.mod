MODULE shared_pers
! source: [K §14.4] one PERS for all tasks that declare it; VAR is each task's own
! task: T_TWO second
  PERS num p := 1;
  VAR num v := 1;
  PERS bool done := FALSE;
  TASK PERS num own := 5;
  PROC main()
    WaitUntil done;
    TPWrite ValToStr(p) + " " + ValToStr(v) + " " + ValToStr(own);
    ! expect: 2 1 5
  ENDPROC
  PROC second()
    p := 2;
    v := 2;
    own := 6;
    done := TRUE;
  ENDPROC
ENDMODULE
