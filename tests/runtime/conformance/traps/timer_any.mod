MODULE timer_any
! source: S4 datasys 2-ITimer names no limit; [mem] 0.1 s, with \Single 0.01 s
! dialect: shortest_timer=any
  VAR intnum cyclic;
  VAR intnum once;
  VAR bool seen := FALSE;
  PROC main()
    CONNECT cyclic WITH ticks;
    CONNECT once WITH ticks;
    ITimer 0.05, cyclic;
    ITimer \Single, 0.005, once;
    WaitTime 1;
    IF seen TPWrite "tick";
    ! expect: tick
  ERROR
    IF ERRNO = ERR_ARGVALERR TPWrite "refused";
    TRYNEXT;
  ENDPROC
  TRAP ticks
    seen := TRUE;
    IDelete cyclic;
  ENDTRAP
ENDMODULE
