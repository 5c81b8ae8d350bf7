MODULE ipers_shown
! source: [K §8, 1A/184] fires when the value changes, not when the same is stored; ITNO names it
  PERS num p := 1;
  VAR intnum i;
  VAR num seen := 0;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    TPWrite ValToStr(seen);
    ! expect: 0
    p := 2;
    WaitTime 0.1;
    TPWrite ValToStr(seen);
    ! expect: trap 2 TRUE
    ! expect: 1
    p := 3;
    WHILE seen < 2 DO
    ENDWHILE
    TPWrite "loop left";
    ! expect: trap 3 TRUE
    ! expect: loop left
  ENDPROC
  TRAP changed
    Incr seen;
    TPWrite "trap " + ValToStr(p) + " " + ValToStr(INTNO = i);
  ENDTRAP
ENDMODULE
