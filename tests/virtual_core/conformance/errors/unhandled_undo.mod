MODULE unhandled_undo
! source: [mem] an unhandled error that leaves the routine runs UNDO
! fault: ERR_DIVZERO 11
  PROC main()
    work;
  ENDPROC
  PROC work()
    VAR num z;
    ! expect: undo
    !
    z := 1 / z;
  UNDO
    TPWrite "undo";
  ENDPROC
ENDMODULE
