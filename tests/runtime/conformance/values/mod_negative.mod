MODULE mod_negative
! source: [S4 overview 4-26] switch negative_mod=error
! dialect: negative_mod=error
! fault: ERR_NEGARG 7
  PROC main()
    VAR num n := -7;
    n := n MOD 2;
  ENDPROC
ENDMODULE
