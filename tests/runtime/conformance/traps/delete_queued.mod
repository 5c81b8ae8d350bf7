MODULE delete_queued
! source: [S4 datasys 2-IDelete-1] a deleted interrupt is not served any more: one that is queued
! because interrupts are disabled, one that is on its way (K §8.1: 2 to 30 ms), each of several; those
! of other interrupts are served, in their order
  VAR intnum first;
  VAR intnum second;
  PERS num p := 0;
  PERS num q := 0;
  PROC main()
    CONNECT first WITH t1;
    CONNECT second WITH t2;
    IPers p, first;
    IPers q, second;
    IDisable;
    p := 1;
    q := 1;
    p := 2;
    q := 2;
    WaitTime 0.1;
    IDelete first;
    IEnable;
    ! expect: second
    ! expect: second
    q := 3;
    IDelete second;
    WaitTime 0.1;
    CONNECT first WITH t1;
    WaitTime 0.1;
    TPWrite "end";
    ! expect: end
  ENDPROC
  TRAP t1
    TPWrite "first";
  ENDTRAP
  TRAP t2
    TPWrite "second";
  ENDTRAP
ENDMODULE
