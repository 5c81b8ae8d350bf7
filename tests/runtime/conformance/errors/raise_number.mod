MODULE raise_number
! source: [K §4.8] RAISE takes 1 to 90 or a booked number; anything else is ERR_ILLRAISE
  VAR errnum mine := -1;
  VAR errnum other := -1;
  PROC main()
    BookErrNo mine;
    BookErrNo other;
    TPWrite ValToStr(mine <> other) + " " + ValToStr(mine > 90);
    ! expect: TRUE TRUE
    RAISE 90;
    RAISE mine;
    RAISE 91;
    RAISE 0;
    RAISE 1.5;
    RAISE ERR_ARGVALERR;
    ! expect: 90
    ! expect: mine
    ! expect: illegal
    ! expect: illegal
    ! expect: illegal
    ! expect: argval
  ERROR
    IF ERRNO = 90 TPWrite "90";
    IF ERRNO = mine TPWrite "mine";
    IF ERRNO = ERR_ILLRAISE TPWrite "illegal";
    IF ERRNO = ERR_ARGVALERR TPWrite "argval";
    TRYNEXT;
  ENDPROC
ENDMODULE
