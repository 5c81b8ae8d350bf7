MODULE div_floor
! source: [mem] switch integer_division=floor
! dialect: integer_division=floor
  PROC main()
    VAR num n := -7;
    TPWrite ValToStr(n DIV 2) + " " + ValToStr(n MOD 2);
    ! expect: -4 1
  ENDPROC
ENDMODULE
