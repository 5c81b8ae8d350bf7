MODULE single
! source: [S4 datasys 2-ISignalDO-1,2] \Single fires at most once; another order needs no CONNECT
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers \Single, p, i;
    p := 1;
    WaitTime 0.1;
    p := 2;
    WaitTime 0.1;
    IPers \Single, p, i;
    p := 3;
    WaitTime 0.1;
    ! expect: trap 1
    ! expect: trap 3
  ENDPROC
  TRAP t
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
