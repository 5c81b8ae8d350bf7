MODULE wait_goes_on
! source: [mem] a wait that a trap interrupts goes on with its remaining time
  VAR intnum i;
  VAR clock c;
  PROC main()
    CONNECT i WITH short;
    ITimer \Single, 0.5, i;
    ClkStart c;
    WaitTime 2;
    ClkStop c;
    TPWrite NumToStr(ClkRead(c),1);
    ! expect: 2.0
  ENDPROC
  TRAP short
    WaitTime 0.5;
  ENDTRAP
ENDMODULE
