MODULE subnormal
! source: [K §2.13] num is an IEEE single: below 1.18E-38 it has fewer digits, below 7E-46 none
  PROC main()
    VAR num x := 1E-38;
    VAR num y;
    VAR pos p;
    y := x / 100000;
    TPWrite ValToStr(y * 1E30 * 1E13);
    y := -x / 100000;
    TPWrite ValToStr(y * 1E30 * 1E13);
    y := x / 1E10;
    TPWrite ValToStr(y = 0);
    p.x := x / 100000;
    TPWrite ValToStr(p.x * 1E30 * 1E13);
    TPWrite ValToStr(half(x / 50000) * 1E30 * 1E13);
    y := (x * 0.7) * 1E-7;
    TPWrite ValToStr(y * 1E30 * 1E15);
    ! expect: 0.994922
    ! expect: -0.994922
    ! expect: TRUE
    ! expect: 0.994922
    ! expect: 1.00893
    ! expect: 0
  ENDPROC
  FUNC num half(num v)
    RETURN v / 2;
  ENDFUNC
ENDMODULE
