MODULE trynext_shown
! source: [K §4.11, 7.2] TRYNEXT skips the failing statement; an error in a condition skips the compound
  PROC main()
    VAR num z := 0;
    VAR num n := 1;
    n := 1 / z;
    TPWrite "n " + ValToStr(n);
    ! expect: n 1
    IF 1 / z > 0 THEN
      TPWrite "never";
    ELSE
      TPWrite "never";
    ENDIF
    WHILE 1 / z > 0 DO
      TPWrite "never";
    ENDWHILE
    FOR i FROM 1 TO 1 / z DO
      TPWrite "never";
    ENDFOR
    TEST 1 / z
    CASE 1:
      TPWrite "never";
    DEFAULT:
      TPWrite "never";
    ENDTEST
    WHILE n < 3 DO
      Incr n;
      z := 1 / 0;
      TPWrite "pass " + ValToStr(n);
    ENDWHILE
    ! expect: pass 2
    ! expect: pass 3
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
