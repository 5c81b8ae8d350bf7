MODULE parameter_modes
! source: [K §5.1] IN is a private copy; VAR, INOUT and PERS stand for the argument
  RECORD pair
    num x;
    string s;
  ENDRECORD
  VAR num g := 1;
  PERS num p := 1;
  VAR num a{2} := [1,1];
  VAR pos v;
  VAR pair r;
  PROC main()
    VAR num l := 1;
    VAR string s := "a";
    byin l;
    TPWrite ValToStr(l);
    ! expect: 1
    byvar l;
    byvar g;
    byvar a{2};
    byvar v.y;
    byvar r.x;
    TPWrite ValToStr(l) + ValToStr(g) + ValToStr(a) + ValToStr(v) + ValToStr(r);
    ! expect: 1111[1,11][0,10,0][10,""]
    byinout l;
    byinout p;
    bypers p;
    TPWrite ValToStr(l) + " " + ValToStr(p);
    ! expect: 111 1101
    text s;
    text r.s;
    TPWrite s + r.s;
    ! expect: aa
    aliased g, g;
    ! expect: 12 12
    through l;
    TPWrite ValToStr(l);
    ! expect: 121
    whole r;
    TPWrite ValToStr(r);
    ! expect: [5,"five"]
    kinds l, p;
    ! expect: FALSETRUE TRUEFALSE
  ENDPROC
  PROC byin(num n)
    n := n + 10;
  ENDPROC
  PROC byvar(VAR num n)
    n := n + 10;
  ENDPROC
  PROC byinout(INOUT num n)
    n := n + 100;
  ENDPROC
  PROC bypers(PERS num n)
    n := n + 1000;
  ENDPROC
  PROC text(VAR string s)
    s := s + s;
    IF s = "" s := "";
  ENDPROC
  PROC aliased(VAR num x, VAR num y)
    x := 12;
    TPWrite ValToStr(x) + " " + ValToStr(y);
  ENDPROC
  PROC through(INOUT num n)
    byvar n;
  ENDPROC
  PROC whole(VAR pair q)
    q := [5, "five"];
  ENDPROC
  PROC kinds(INOUT num x, INOUT num y)
    TPWrite ValToStr(IsPers(x)) + ValToStr(IsPers(y)) + " " + ValToStr(IsVar(x)) + ValToStr(IsVar(y));
  ENDPROC
ENDMODULE
