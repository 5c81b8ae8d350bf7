MODULE long_jump_out
! source: [K §7.2] a listed handler at a lower execution level may take an error out of a trap
  VAR intnum i;
  PROC main()
    CONNECT i WITH bad;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    TPWrite "after the wait";
    ! expect: trap
    ! expect: main TRUE
    ! expect: after the wait
  ERROR (ERR_DIVZERO)
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  TRAP bad
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "trap";
    RAISE;
  ENDTRAP
ENDMODULE
