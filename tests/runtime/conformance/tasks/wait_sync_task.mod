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
