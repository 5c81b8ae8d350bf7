MODULE unknown_function
! source: [K §12] ERR_REFUNKFUN: reached, not linked; motion_program_exec [code] calls what another
! module may bring, as a bool, a string and a record
  PROC main()
    VAR string s;
    VAR pos p;
    IF FALSE THEN
      s := nowhere_string();
      p := nowhere_pos(1);
    ENDIF
    TPWrite "before";
    ! expect: before
    IF nowhere_bool(s) TPWrite "never";
    TPWrite "after";
    ! expect: unknown
    ! expect: after
    RETURN;
  ERROR
    IF ERRNO = ERR_REFUNKFUN TPWrite "unknown";
    TRYNEXT;
  ENDPROC
ENDMODULE
