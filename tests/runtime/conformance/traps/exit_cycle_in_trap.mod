MODULE exit_cycle_in_trap
! source: [S4 datasys 2-ExitCycle-1, abb_driver] ExitCycle in a trap drops what it interrupted; the order stays
! cycle: 5
  PERS num p := 0;
  VAR intnum i;
  VAR num cycles := 0;
  PROC main()
    Incr cycles;
    TPWrite "main " + ValToStr(cycles);
    IDelete i;
    CONNECT i WITH changed;
    IPers p, i;
    IF cycles > 2 EXIT;
    p := p + 1;
    WaitTime 10;
    TPWrite "never";
    ! expect: main 1
    ! expect: trap
    ! expect: main 2
    ! expect: trap
    ! expect: main 3
  ENDPROC
  TRAP changed
    TPWrite "trap";
    ExitCycle;
  ENDTRAP
ENDMODULE
