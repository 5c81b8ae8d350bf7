MODULE lock_shown
! source: [S4 datasys 3-TestAndSet-3,4] WaitTestAndSet: only one task holds the flag
! task: T_TWO second
  PERS bool lock := FALSE;
  PERS num inside := 0;
  PERS num worst := 0;
  PERS num rounds := 0;
  PROC work()
    FOR i FROM 1 TO 20 DO
      WaitTestAndSet lock;
      inside := inside + 1;
      IF inside > worst worst := inside;
      WaitTime 0.01;
      inside := inside - 1;
      rounds := rounds + 1;
      lock := FALSE;
    ENDFOR
  ENDPROC
  PROC main()
    work;
    WaitUntil rounds = 40;
    TPWrite ValToStr(worst) + " " + ValToStr(TestAndSet(lock)) + ValToStr(TestAndSet(lock));
    ! expect: 1 TRUEFALSE
  ENDPROC
  PROC second()
    work;
  ENDPROC
ENDMODULE
