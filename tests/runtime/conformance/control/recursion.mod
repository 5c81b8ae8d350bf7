MODULE recursion
! source: [K §2.21] routine data are one instance per recursive call
  PROC main()
    VAR num n := 0;
    TPWrite ValToStr(fac(6)) + " " + walk(3);
    ! expect: 720 3(2(1(0)1)2)3
    nest 2000, n;
    TPWrite ValToStr(n);
    ! expect: 2.001E+06
  ENDPROC
  FUNC num fac(num n)
    IF n <= 1 RETURN 1;
    RETURN n * fac(n - 1);
  ENDFUNC
  FUNC string walk(num n)
    VAR num mine;
    VAR string inside;
    mine := n;
    IF n = 0 RETURN "0";
    inside := walk(n - 1);
    RETURN NumToStr(mine,0) + "(" + inside + ")" + NumToStr(mine,0);
  ENDFUNC
  PROC nest(num depth, INOUT num total)
    IF depth = 0 RETURN;
    total := total + depth;
    nest depth - 1, total;
  ENDPROC
ENDMODULE
