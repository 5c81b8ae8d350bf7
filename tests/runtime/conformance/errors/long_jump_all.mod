MODULE long_jump_all
! source: [K §7.2] LONG_JMP_ALL_ERR lists every error
  PROC main()
    middle;
    TPWrite "end";
    ! expect: main TRUE
    ! expect: end
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
