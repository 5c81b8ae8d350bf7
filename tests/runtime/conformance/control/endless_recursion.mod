MODULE endless_recursion
! source: [K §1.4] stack overflow is a fatal execution error: no handler sees it
! fault: 40027 11
  PROC main()
    deeper 1;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC deeper(num n)
    deeper n + 1;
  ENDPROC
ENDMODULE
