MODULE of_their_task
! source: [S4 overview 4-48, K §14.2] each task has its own interrupts: IDisable is one task's
! task: T_BACK other
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    IDisable;
    WaitTime 1;
    TPWrite "main";
    IEnable;
    WaitTime 0.1;
    ! expect: trap of T_BACK
    ! expect: main
    ! expect: trap of T_ROB1
  ENDPROC
  PROC other()
    CONNECT i WITH t;
    IPers p, i;
    WaitTime 0.1;
    p := 1;
    WaitTime 0.5;
  ENDPROC
  TRAP t
    TPWrite "trap of " + GetTaskName();
  ENDTRAP
ENDMODULE
