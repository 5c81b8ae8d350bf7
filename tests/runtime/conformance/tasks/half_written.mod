MODULE half_written
! source: [S4 overview 4-47, K §14.2] a record written by components can be read half-written
! task: T_BACK other
  PERS pos p := [0,0,0];
  PERS bool seen := FALSE;
  PROC main()
    p.x := 1;
    WaitUntil seen;
    p.y := 1;
  ENDPROC
  PROC other()
    WaitTime 0.01;
    TPWrite ValToStr(p);
    seen := TRUE;
    WaitTime 0.5;
    TPWrite ValToStr(p);
    ! expect: [1,0,0]
    ! expect: [1,1,0]
  ENDPROC
ENDMODULE
