MODULE raise_in_handler_error
! source: [K §4.8] RAISE with a number must not stand in an error handler
! dialect: raise_in_handler=error
! fault: 40001 12
  PROC main()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ERROR
    TPWrite "handler";
    ! expect: handler
    RAISE 8;
  ENDPROC
ENDMODULE
