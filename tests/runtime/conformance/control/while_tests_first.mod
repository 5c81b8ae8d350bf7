MODULE while_tests_first
! source: [K §4.16]
  PROC main()
    VAR num n := 3;
    WHILE n > 3 DO
      TPWrite "never";
    ENDWHILE
    WHILE n > 0 DO
      n := n - 2;
    ENDWHILE
    TPWrite ValToStr(n);
    ! expect: -1
    WHILE down(n) DO
    ENDWHILE
    TPWrite ValToStr(n);
    ! expect: -3
  ENDPROC
  FUNC bool down(INOUT num n)
    n := n - 1;
    RETURN n > -3;
  ENDFUNC
ENDMODULE
