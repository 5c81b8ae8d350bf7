MODULE exit_cycle
! source: [S4 datasys 2-ExitCycle-1] data are kept, the call stack is dropped; routine data start afresh
! cycle: 4
  VAR num n := 0;
  PERS num p := 5;
  PROC main()
    VAR num own := 0;
    Incr own;
    Incr n;
    IF n > 4 EXIT;
    TPWrite ValToStr(n) + " " + ValToStr(own);
    deeper;
    TPWrite "never";
    ! expect: 1 1
    ! expect: 2 1
    ! expect: 3 1
    ! expect: 4 1
  ENDPROC
  PROC deeper()
    IF n < 9 ExitCycle;
  ENDPROC
ENDMODULE
