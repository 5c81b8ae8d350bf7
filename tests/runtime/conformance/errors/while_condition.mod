MODULE while_condition
! source: [K §7.2] TRYNEXT after an error in a condition skips the whole of the compound statement
  VAR num n := 0;
  PROC main()
    WHILE fine("while") DO
      TPWrite "pass";
    ENDWHILE
    TPWrite "behind while";
    n := 0;
    IF fine("if") THEN
      TPWrite "then";
    ELSE
      TPWrite "never";
    ENDIF
    IF fine("if") THEN
      TPWrite "never";
    ELSE
      TPWrite "never";
    ENDIF
    TPWrite "behind if";
    ! expect: pass
    ! expect: failed in while
    ! expect: behind while
    ! expect: then
    ! expect: failed in if
    ! expect: behind if
  ERROR
    TRYNEXT;
  ENDPROC
  FUNC bool fine(string where)
    n := n + 1;
    IF n = 2 THEN
      TPWrite "failed in " + where;
      RAISE 5;
    ENDIF
    RETURN TRUE;
  ERROR
    RAISE;
  ENDFUNC
ENDMODULE
