MODULE listed_shown
! source: [K §7.1] ERROR (list) takes only what it lists from its own body
  CONST errnum MINE := 7;
  PROC main()
    a 7;
    a 8;
    ! expect: a 7
    ! expect: main 8
  ERROR
    TPWrite "main " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC a(num n)
    RAISE n;
  ERROR (MINE, ERR_DIVZERO)
    TPWrite "a " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
ENDMODULE
