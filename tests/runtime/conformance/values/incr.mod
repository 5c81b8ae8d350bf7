MODULE incr_shown
! source: [S4 datasys 2-Add-1] Incr, Decr, Add, Clear on variables and persistents
  PERS num p := 5;
  VAR num a{2};
  VAR pos v;
  PROC main()
    VAR num n := 1;
    VAR dnum d := 1;
    Incr n;
    Add n, 2.5;
    Decr n;
    Add n, -1;
    Incr p;
    Decr a{2};
    Add v.z, 3;
    Add d, 0.1;
    TPWrite ValToStr(n) + " " + ValToStr(p) + ValToStr(a) + ValToStr(v);
    ! expect: 2.5 6[0,-1][0,0,3]
    Clear p;
    Clear n;
    TPWrite ValToStr(p) + ValToStr(n);
    ! expect: 00
  ENDPROC
ENDMODULE
