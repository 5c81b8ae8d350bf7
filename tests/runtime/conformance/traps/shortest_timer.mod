MODULE shortest_timer
! source: a backup of a YuMi (bestin-07/ATOM_ABB-YUMI) [cfg] starts such a timer; 0.01 as a num is a little less
  VAR intnum i;
  PROC main()
    CONNECT i WITH t;
    ITimer \Single, 0.01, i;
    WaitTime 0.1;
    ! expect: trap
  ENDPROC
  TRAP t
    TPWrite "trap";
  ENDTRAP
ENDMODULE
