MODULE if_first_true
! source: [K §4.13] conditions in order until one is TRUE; [K §3] AND and OR skip the right side
  VAR num calls := 0;
  FUNC bool yes()
    Incr calls;
    RETURN TRUE;
  ENDFUNC
  PROC main()
    VAR num n := 2;
    IF n = 1 THEN
      TPWrite "one";
    ELSEIF n = 2 THEN
      TPWrite "two";
    ELSEIF yes() THEN
      TPWrite "call";
    ELSE
      TPWrite "else";
    ENDIF
    ! expect: two
    IF n = 3 AND yes() TPWrite "never";
    IF n = 2 OR yes() TPWrite "or";
    ! expect: or
    TPWrite ValToStr(calls);
    ! expect: 0
    IF n = 9 THEN
    ELSEIF yes() THEN
      TPWrite "late";
    ENDIF
    ! expect: late
    IF (n = 2) XOR yes() THEN
      TPWrite "never";
    ELSE
      TPWrite ValToStr(calls);
    ENDIF
    ! expect: 2
  ENDPROC
ENDMODULE
