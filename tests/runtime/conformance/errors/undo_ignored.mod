MODULE undo_ignored
! source: [mem] the other answer: an error in UNDO ends that handler only
! dialect: undo_error=ignore
  PROC main()
    VAR num z;
    outer;
    TPWrite "never";
    ! expect: inner
    ! expect: undo of inner
    ! expect: undo of outer
  ENDPROC
  PROC outer()
    inner;
  UNDO
    TPWrite "undo of outer";
  ENDPROC
  PROC inner()
    TPWrite "inner";
    ExitCycle;
  UNDO
    TPWrite "undo of inner";
    fails;
    TPWrite "never";
  ENDPROC
  PROC fails()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
