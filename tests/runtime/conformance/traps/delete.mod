MODULE delete
! source: [S4 datasys 2-IDelete-1, 2-ISleep-1,2] event and connection go; another CONNECT is needed
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    IDelete i;
    p := 2;
    WaitTime 0.1;
    ISleep i;
    CONNECT i WITH t;
    IPers p, i;
    p := 3;
    WaitTime 0.1;
    ! expect: trap 1
    ! expect: unknown
    ! expect: trap 3
  ERROR
    IF ERRNO = ERR_UNKINO TPWrite "unknown";
    TRYNEXT;
  ENDPROC
  TRAP t
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
