MODULE stop_switch
! source: [mem] switch unhandled_error=stop: later manuals let the system error handler take over at once
! dialect: unhandled_error=stop
! fault: ERR_DIVZERO 13
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
