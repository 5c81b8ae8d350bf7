MODULE signals
! source: [S4 datasys 2-ISignalDO-1,2] edges only: a level that is already there does not fire
! signal: do1 DO
  VAR intnum up;
  VAR intnum down;
  VAR intnum both;
  VAR num n{3};
  PROC main()
    SetDO do1, 1;
    CONNECT up WITH t_up;
    CONNECT down WITH t_down;
    CONNECT both WITH t_both;
    ISignalDO do1, 1, up;
    ISignalDO do1, 0, down;
    ISignalDO do1, edge, both;
    WaitTime 0.2;
    TPWrite ValToStr(n);
    ! expect: [0,0,0]
    SetDO do1, 1;
    SetDO do1, 0;
    SetDO do1, 1;
    WaitTime 0.2;
    TPWrite ValToStr(n);
    ! expect: [1,1,2]
  ENDPROC
  TRAP t_up
    Incr n{1};
  ENDTRAP
  TRAP t_down
    Incr n{2};
  ENDTRAP
  TRAP t_both
    Incr n{3};
  ENDTRAP
ENDMODULE
