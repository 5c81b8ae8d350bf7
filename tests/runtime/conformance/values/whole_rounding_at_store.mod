MODULE whole_rounding_at_store
! source: [mem] switch num_rounding=store: an expression keeps more digits than a num
  PROC main()
    VAR num big := 16777216;
    VAR num one := 1;
    VAR num sum;
    TPWrite ValToStr(big + one - big);
    sum := big + one;
    TPWrite ValToStr(sum - big);
    ! expect: 1
    ! expect: 0
  ENDPROC
ENDMODULE
