MODULE error_in_handler
! source: [K §7.1] an error inside a handler cannot be handled
! fault: ERR_OUTOFBND 17
  VAR num a{2};
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "first";
    ! expect: first
    a{3} := 1;
    TRYNEXT;
  ENDPROC
ENDMODULE
