MODULE argument_error
! source: 3HAC16581-1 has ERR_ARGVALERR [manual]; that a handler gets it [mem]
  PROC main()
    VAR num n;
    n := Sqrt(-1);
    ! expect: argument
    TPWrite "goes on";
    ! expect: goes on
  ERROR
    IF ERRNO = ERR_ARGVALERR TPWrite "argument";
    TRYNEXT;
  ENDPROC
ENDMODULE
