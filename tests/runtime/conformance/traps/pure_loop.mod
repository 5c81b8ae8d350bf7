MODULE pure_loop
! source: [K §8.1] a trap starts at the next statement, also in a loop that waits for nothing
  VAR intnum i;
  VAR bool stop_ := FALSE;
  PROC main()
    CONNECT i WITH tick;
    ITimer \Single, 0.5, i;
    WHILE NOT stop_ DO
    ENDWHILE
    TPWrite "left";
    ! expect: left
  ENDPROC
  TRAP tick
    stop_ := TRUE;
  ENDTRAP
ENDMODULE
