MODULE when_they_come
! source: [K §8.1] a trap comes 2 to 30 ms after its event
! expect: TRUE
! expect: TRUE
  VAR intnum i;
  PERS num p := 0;
  VAR clock c;
  VAR num least := 99;
  VAR num most := 0;
  TRAP t
    VAR num seconds;
    seconds := ClkRead(c \HighRes);
    IF seconds < least least := seconds;
    IF seconds > most most := seconds;
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    FOR k FROM 1 TO 100 DO
      ClkReset c;
      ClkStart c;
      p := p + 1;
      WaitTime 0.1;
      ClkStop c;
    ENDFOR
    TPWrite ValToStr(0.002 <= least AND least < 0.005);
    TPWrite ValToStr(0.025 < most AND most < 0.0305);
  ENDPROC
ENDMODULE
