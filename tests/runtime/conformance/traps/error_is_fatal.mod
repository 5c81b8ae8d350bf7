MODULE error_is_fatal
! source: [K §8.3, manual BC/112] an error that leaves a trap is not passed to what it interrupted
! fault: ERR_DIVZERO 17
  VAR intnum i;
  PROC main()
    CONNECT i WITH bad;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    TPWrite "never";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  TRAP bad
    VAR num z;
    ! here
    z := 1 / z;
  ENDTRAP
ENDMODULE
