MODULE stop_switch
! source: logs of controllers (RobotWare 6.03, 6.15) and ABB's modules for RobotWare 7: the system error handler takes over at once
! fault: ERR_DIVZERO 12
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
