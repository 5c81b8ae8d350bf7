MODULE unhandled_undo
! source: [mem] an unhandled error that leaves the routine runs UNDO
! dialect: after_error=main
! fault: ERR_DIVZERO 12
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
