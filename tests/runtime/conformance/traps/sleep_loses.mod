MODULE sleep_loses
! source: [S4 datasys 2-ISleep-1,2] events during sleep are ignored for good; ERR_UNKINO
  PERS num p := 0;
  VAR intnum i;
  VAR intnum none;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    ISleep i;
    p := 1;
    WaitTime 1;
    IWatch i;
    WaitTime 1;
    p := 2;
    WaitTime 1;
    ISleep none;
    TPWrite "end";
    ! expect: trap 2
    ! expect: unknown
    ! expect: end
  ERROR
    IF ERRNO = ERR_UNKINO TPWrite "unknown";
    TRYNEXT;
  ENDPROC
  TRAP changed
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
