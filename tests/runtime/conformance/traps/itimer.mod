MODULE itimer_shown
! source: [S4 datasys 2-ITimer-1,2] first shot after one period, then each period; \Single once
  VAR intnum i;
  VAR intnum j;
  VAR num ticks := 0;
  VAR num once := 0;
  PROC main()
    CONNECT i WITH tick;
    CONNECT j WITH shot;
    ITimer 0.5, i;
    ITimer \Single, 0.2, j;
    WaitTime 5.3;
    TPWrite ValToStr(ticks) + " " + ValToStr(once);
    ! expect: 10 1
    IDelete i;
    WaitTime 2;
    TPWrite ValToStr(ticks);
    ! expect: 10
  ENDPROC
  TRAP tick
    Incr ticks;
  ENDTRAP
  TRAP shot
    Incr once;
  ENDTRAP
ENDMODULE
