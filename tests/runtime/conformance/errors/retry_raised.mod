MODULE retry_raised
! source: [S4 datasys 2-RETRY-1] switch retry_raised=false: RETRY is not for an error made by RAISE
! dialect: retry_raised=false
! fault: 40199 14
  VAR num n := 0;
  PROC main()
    once;
    TPWrite "never";
    ! expect: handler
  ENDPROC
  PROC once()
    VAR num k;
    n := n + 1;
    RAISE 5;
  ERROR
    TPWrite "handler";
    RETRY;
  ENDPROC
ENDMODULE
