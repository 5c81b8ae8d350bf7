MODULE handler_end
! source: [K §7.1] the end of a handler without RETRY, TRYNEXT, RETURN or RAISE: system error handler
! fault: ERR_DIVZERO 17
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    ! expect: handler
    divide;
  ENDPROC
  PROC divide()
    VAR num z;
    ! the error
    z := 1 / z;
  ERROR
    TPWrite "handler";
  ENDPROC
ENDMODULE
