MODULE constants
! source: [K §2.22, 3.1] constants and initial values are constant expressions, in any order of declaration
  CONST num DOUBLE_ := BASE * 2;
  CONST num BASE := 21;
  VAR num list{BASE - 19} := [BASE, DOUBLE_];
  CONST pos CORNER := [BASE, -BASE, BASE / 4];
  VAR num first := CORNER.y;
  CONST string HELLO := "hel" + "lo";
  CONST bool BIG := BASE > 20 AND NOT FALSE;
  PROC main()
    VAR num own := DOUBLE_ + 1;
    CONST num HERE := 3;
    TPWrite ValToStr(list) + ValToStr(CORNER) + ValToStr(first) + HELLO + ValToStr(BIG);
    ! expect: [21,42][21,-21,5.25]-21helloTRUE
    TPWrite ValToStr(own + HERE);
    ! expect: 46
  ENDPROC
ENDMODULE
