MODULE endless_recursion_in_undo
! source: [K §1.4] stack overflow is fatal, wherever it happens
! fault: 40027 8
  PROC main()
    again;
  ENDPROC
  PROC again()
    again;
  ERROR
    again;
    RETRY;
  UNDO
    again;
  ENDPROC
ENDMODULE
