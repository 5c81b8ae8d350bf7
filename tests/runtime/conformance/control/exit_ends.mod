MODULE exit_ends
! source: [K §4.9] EXIT ends the task, UNDO runs on the way
  PROC main()
    inner;
    TPWrite "never";
  ENDPROC
  PROC inner()
    EXIT;
    TPWrite "never";
  UNDO
    TPWrite "undo";
    ! expect: undo
  ENDPROC
ENDMODULE
