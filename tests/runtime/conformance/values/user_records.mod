MODULE user_records
! source: [K §2.14, 2.15, 2.17] records of records, aliases, components with names of Python's own
  RECORD point
    num x;
    num from_;
    bool is;
    string class;
  ENDRECORD
  RECORD line
    point a;
    point b;
    num copy;
  ENDRECORD
  ALIAS num level;
  VAR line l := [[1,2,TRUE,"c"],[3,4,FALSE,"d"],5];
  PROC main()
    VAR level n := 3;
    VAR num m;
    VAR line k;
    m := n;
    n := m + l.copy;
    k := l;
    k.a.is := FALSE;
    k.b.class := "e";
    k.a.from_ := n;
    TPWrite ValToStr(k);
    ! expect: [[1,8,FALSE,"c"],[3,4,FALSE,"e"],5]
    TPWrite ValToStr(l);
    ! expect: [[1,2,TRUE,"c"],[3,4,FALSE,"d"],5]
  ENDPROC
ENDMODULE
