!=== fault_stops_normal
MODULE fault_stops_normal
! source: [S4 overview 4-45] a fault of a NORMAL task stops the other NORMAL tasks
! task: T_TWO second
! until: 3
! fault: ERR_DIVZERO 15
  PROC main()
    WaitTime 2;
    TPWrite "never";
  ENDPROC
  PROC second()
    VAR num z;
    WaitTime 1;
    TPWrite "divides";
    ! expect: divides
    z := 1 / z;
  ENDPROC
ENDMODULE
!=== half_written
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
!=== lock
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
!=== shared_pers
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
!=== wait_sync_task
MODULE wait_sync_task
! source: [manual DB] WaitSyncTask: all tasks of the list must come; \TimeOut: ERR_WAITSYNCTASK
! task: T_TWO second
  PERS tasks both{2} := [["T_ROB1"],["T_TWO"]];
  PERS string text := "";
  VAR syncident here;
  VAR syncident alone;
  PROC main()
    text := "early";
    WaitSyncTask here, both;
    TPWrite text;
    ! expect: late
    WaitSyncTask alone, both \TimeOut:=0.5;
    TPWrite "end " + GetTaskName() + ValToStr(TaskIsExecuting(TaskName:="T_TWO"));
    ! expect: timeout
    ! expect: end T_ROB1FALSE
  ERROR
    IF ERRNO = ERR_WAITSYNCTASK TPWrite "timeout";
    TRYNEXT;
  ENDPROC
  PROC second()
    WaitTime 1;
    text := "late";
    WaitSyncTask here, both;
  ENDPROC
ENDMODULE
!=== wait_until
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
!=== wait_until_event
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
