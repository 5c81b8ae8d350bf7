MODULE comparisons
! source: [K §3.11] = and <> compare any value type, records and arrays whole
  RECORD pair
    num n;
    string s;
  ENDRECORD
  PROC main()
    VAR pair a := [1,"x"];
    VAR pair b := [1,"x"];
    VAR pos list{2} := [[1,2,3],[4,5,6]];
    VAR pos other{2} := [[1,2,3],[4,5,6]];
    TPWrite ValToStr(a = b) + ValToStr(a <> b);
    b.s := "y";
    TPWrite ValToStr(a = b) + ValToStr(a <> b);
    TPWrite ValToStr(list = other);
    other{2}.z := 0;
    TPWrite ValToStr(list = other) + ValToStr(list <> other);
    TPWrite ValToStr("a" = "A") + ValToStr(TRUE <> FALSE);
    TPWrite ValToStr(1 < 2) + ValToStr(2 <= 2) + ValToStr(1 > 2) + ValToStr(2 >= 3);
    ! expect: TRUEFALSE
    ! expect: FALSETRUE
    ! expect: TRUE
    ! expect: FALSETRUE
    ! expect: FALSETRUE
    ! expect: TRUETRUEFALSEFALSE
  ENDPROC
ENDMODULE
