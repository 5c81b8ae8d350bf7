MODULE propagation
! source: [K §7.1, S4 overview 4-37] a routine without ERROR passes the error to its caller; TRYNEXT continues after the call
! dialect: unhandled_error=propagate
  PROC main()
    TPWrite "start";
    ! expect: start
    middle;
    TPWrite "after";
    ! expect: caught
    ! expect: after
  ERROR
    TPWrite "caught";
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
    TPWrite "never";
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ENDPROC
ENDMODULE
