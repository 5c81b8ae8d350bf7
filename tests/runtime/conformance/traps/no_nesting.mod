MODULE no_nesting
! source: [K §8.2, 8.3] while a trap runs interrupts wait, then they are raised in order
  PERS num p := 0;
  VAR intnum i;
  VAR intnum j;
  PROC main()
    CONNECT i WITH slow;
    CONNECT j WITH quick;
    IPers p, i;
    ITimer \Single, 0.5, j;
    p := 1;
    WaitTime 3;
    TPWrite "end";
    ! expect: slow begins
    ! expect: slow ends
    ! expect: quick
    ! expect: end
  ENDPROC
  TRAP slow
    TPWrite "slow begins";
    WaitTime 1;
    TPWrite "slow ends";
  ENDTRAP
  TRAP quick
    TPWrite "quick";
  ENDTRAP
ENDMODULE
