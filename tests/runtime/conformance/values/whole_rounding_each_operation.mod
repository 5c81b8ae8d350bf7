MODULE whole_rounding_each_operation
! source: [mem] switch num_rounding=operation: 16777216 + 1 is 16777216 as a single
! dialect: num_rounding=operation
  PROC main()
    VAR num big := 16777216;
    VAR num one := 1;
    TPWrite ValToStr(big + one = big);
    TPWrite ValToStr(big + one - big);
    TPWrite ValToStr(big * 2 + one - big * 2);
    TPWrite ValToStr(one + one + one = 3);
    ! expect: TRUE
    ! expect: 0
    ! expect: 0
    ! expect: TRUE
  ENDPROC
ENDMODULE
