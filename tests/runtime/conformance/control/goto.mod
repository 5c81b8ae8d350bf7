MODULE goto_shown
! source: [K §4.3, 4.6] a label's list may be left and entered again from inside
  PROC main()
    VAR num i := 0;
  again:
    Incr i;
    IF i < 3 GOTO again;
    TPWrite ValToStr(i);
    ! expect: 3
    FOR a FROM 1 TO 5 DO
      FOR c FROM 1 TO 5 DO
        IF a * c = 6 THEN
          TPWrite ValToStr(a) + "*" + ValToStr(c);
          GOTO found;
        ENDIF
      ENDFOR
    ENDFOR
    TPWrite "never";
  found:
    ! expect: 2*3
    WHILE TRUE DO
      Incr i;
    inner:
      i := i + 10;
      IF i < 40 GOTO inner;
      IF i >= 40 GOTO out;
    ENDWHILE
  out:
    TPWrite ValToStr(i);
    ! expect: 44
    GOTO last;
    TPWrite "never";
  last:
  ENDPROC
ENDMODULE
