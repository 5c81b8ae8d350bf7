MODULE div_mod
! source: [K §3.11, 12] whole operands, divisor of MOD not negative; [mem] DIV goes towards zero
  PROC main()
    VAR num z;
    VAR num n := -7;
    TPWrite ValToStr(14 DIV 4) + " " + ValToStr(14 MOD 4);
    ! expect: 3 2
    TPWrite ValToStr(n DIV 2) + " " + ValToStr(n MOD 2);
    ! expect: -3 -1
    TPWrite ValToStr(7 DIV (-2));
    ! expect: -3
    z := 1 DIV 0;
    ! expect: DIVZERO
    z := 1 MOD 0;
    ! expect: DIVZERO
    z := 1.5 DIV 1;
    ! expect: NOTINTVAL
    z := 5 MOD (-2);
    ! expect: NEGARG
    TPWrite ValToStr(z);
    ! expect: 0
  ERROR
    IF ERRNO = ERR_DIVZERO TPWrite "DIVZERO";
    IF ERRNO = ERR_NOTINTVAL TPWrite "NOTINTVAL";
    IF ERRNO = ERR_NEGARG TPWrite "NEGARG";
    TRYNEXT;
  ENDPROC
ENDMODULE
