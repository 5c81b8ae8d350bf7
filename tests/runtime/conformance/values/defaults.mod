MODULE defaults
! source: [K §2.21, 2.22, 2.23] uninitialised data are 0, FALSE, ""; routine data start afresh at each call
  VAR num n;
  VAR bool b;
  VAR string s;
  VAR robtarget t;
  PERS num bare;
  VAR num after;
  PROC main()
    TPWrite ValToStr(n) + ValToStr(b) + ValToStr(s) + ValToStr(t.rot) + ValToStr(bare);
    ! expect: 0FALSE""[0,0,0,0]0
    count;
    count;
    ! expect: 1 [0,0]
    ! expect: 1 [0,0]
  ENDPROC
  PROC count()
    VAR num own;
    VAR num list{2};
    Incr own;
    TPWrite ValToStr(own) + " " + ValToStr(list);
    list{1} := 5;
  ENDPROC
ENDMODULE
