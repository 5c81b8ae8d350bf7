MODULE rounding_each_operation
! source: [mem] switch num_rounding=operation
! dialect: num_rounding=operation
  PROC main()
    VAR num x;
    x := 1 / 3;
    TPWrite ValToStr(x = 1 / 3);
    ! expect: TRUE
  ENDPROC
ENDMODULE
