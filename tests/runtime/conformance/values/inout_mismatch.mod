MODULE inout_mismatch
! source: [K §5.1, 12] an INOUT parameter passed on as VAR or PERS is checked when it happens
! dialect: unhandled_error=propagate
  PERS num p := 1;
  PROC main()
    VAR num l := 1;
    as_var l;
    as_var p;
    as_pers l;
    as_pers p;
    TPWrite ValToStr(l) + " " + ValToStr(p);
    ! expect: NOTVAR
    ! expect: NOTPER
    ! expect: 2 3
  ERROR
    IF ERRNO = ERR_ARGNOTVAR TPWrite "NOTVAR";
    IF ERRNO = ERR_ARGNOTPER TPWrite "NOTPER";
    TRYNEXT;
  ENDPROC
  PROC as_var(INOUT num n)
    var_ n;
  ENDPROC
  PROC as_pers(INOUT num n)
    pers_ n;
  ENDPROC
  PROC var_(VAR num n)
    n := n + 1;
  ENDPROC
  PROC pers_(PERS num n)
    n := n + 2;
  ENDPROC
ENDMODULE
