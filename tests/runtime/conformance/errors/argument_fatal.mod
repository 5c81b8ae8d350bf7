MODULE argument_fatal
! source: [mem] the other answer: a refused argument stops the task; RAISE of that error does not
! dialect: argument_error=fatal
! fault: ERR_ARGVALERR 11
  PROC main()
    VAR num n;
    again;
    ! expect: raised
    TPWrite "goes on";
    ! expect: goes on
    n := Sqrt(-1);
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC again()
    RAISE ERR_ARGVALERR;
  ERROR
    TPWrite "raised";
    TRYNEXT;
  ENDPROC
ENDMODULE
