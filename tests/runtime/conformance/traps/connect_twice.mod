MODULE connect_twice
! source: [K §4.12, 12] a connected number cannot be connected again: ERR_ALRDYCNT; IDelete frees it
  VAR intnum i;
  PROC main()
    CONNECT i WITH a;
    CONNECT i WITH a;
    CONNECT i WITH b;
    IDelete i;
    CONNECT i WITH b;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    ! expect: ALRDYCNT
    ! expect: ALRDYCNT
    ! expect: b
  ERROR
    IF ERRNO = ERR_ALRDYCNT TPWrite "ALRDYCNT";
    TRYNEXT;
  ENDPROC
  TRAP a
    TPWrite "a";
  ENDTRAP
  TRAP b
    TPWrite "b";
  ENDTRAP
ENDMODULE
