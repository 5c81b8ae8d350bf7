MODULE num_is_single
! source: [K §2.13] num is IEEE single; rounded at store, argument passing and RETURN
  RECORD box
    num n;
  ENDRECORD
  PERS num kept := 0;
  VAR num m;
  VAR num a{2};
  VAR box r;
  PROC main()
    VAR num x;
    VAR num y := 0.1;
    VAR num big := 16777216;
    VAR dnum d := 0.1;
    x := 1 / 3;
    TPWrite ValToStr(x = 1 / 3);
    ! expect: FALSE
    m := 1 / 3;
    kept := 1 / 3;
    a{1} := 1 / 3;
    r.n := 1 / 3;
    TPWrite ValToStr(x = m) + ValToStr(x = kept) + ValToStr(x = a{1}) + ValToStr(x = r.n);
    ! expect: TRUETRUETRUETRUE
    TPWrite ValToStr(x = arg(1 / 3)) + ValToStr(x = result()) + ValToStr([1 / 3] = r);
    ! expect: TRUETRUETRUE
    TPWrite ValToStr(big + 1 = big) + ValToStr(stored(big + 1) = big);
    ! expect: FALSETRUE
    big := 16777215;
    FOR i FROM 1 TO 3 DO
      big := big + 1;
    ENDFOR
    TPWrite ValToStr(big = 16777216);
    ! expect: TRUE
    TPWrite ValToStr(y = 0.1) + ValToStr(NumToDnum(y) = d);
    ! expect: TRUEFALSE
    d := 1 / 3;
    TPWrite ValToStr(d * 3 = 1);
    ! expect: TRUE
  ENDPROC
  FUNC num arg(num n)
    RETURN n;
  ENDFUNC
  FUNC num result()
    RETURN 1 / 3;
  ENDFUNC
  FUNC num stored(num n)
    VAR num copy;
    copy := n;
    RETURN copy;
  ENDFUNC
ENDMODULE
