MODULE undo_fails
! source: [mem] an error in UNDO stops the task; the other UNDO handlers are left out
! fault: ERR_DIVZERO 27
  PROC main()
    outer;
    ! expect: inner
    ! expect: undo of inner
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC outer()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC
  PROC inner()
    VAR num z;
    TPWrite "inner";
    ExitCycle;
  UNDO
    TPWrite "undo of inner";
    fails;
  ENDPROC
  PROC fails()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
