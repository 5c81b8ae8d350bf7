MODULE disable_queues
! source: [K §8.2, manual DB] between IDisable and IEnable events queue and come in order
  PERS num p := 0;
  VAR intnum i;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    IDisable;
    p := 1;
    p := 2;
    WaitTime 1;
    TPWrite "enable";
    IEnable;
    TPWrite "end";
    ! expect: enable
    ! expect: trap
    ! expect: trap
    ! expect: end
  ENDPROC
  TRAP changed
    TPWrite "trap";
  ENDTRAP
ENDMODULE
