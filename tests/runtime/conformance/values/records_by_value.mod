MODULE records_by_value
! source: [K §4.4, 5.1, 3.11] records are copied at assignment, by IN parameters and by RETURN; = is component-wise
  VAR pose g := [[1,2,3],[1,0,0,0]];
  PERS pos shared := [7,8,9];
  PROC main()
    VAR pose p;
    VAR pose q;
    VAR pos v;
    VAR pos list{2};
    p := g;
    p.trans.x := 10;
    TPWrite ValToStr(g.trans.x) + " " + ValToStr(p.trans.x);
    ! expect: 1 10
    v := p.trans;
    v.y := 20;
    TPWrite ValToStr(p.trans);
    ! expect: [10,2,3]
    p.trans := v;
    v.z := 30;
    TPWrite ValToStr(p.trans);
    ! expect: [10,20,3]
    list{1} := v;
    list{2} := list{1};
    list{1}.x := 99;
    TPWrite ValToStr(list);
    ! expect: [[99,20,30],[10,20,30]]
    change v;
    TPWrite ValToStr(v);
    ! expect: [10,20,30]
    q := same(p);
    q.trans.x := 5;
    TPWrite ValToStr(p.trans.x) + " " + ValToStr(p = q);
    ! expect: 10 FALSE
    q.trans.x := 10;
    TPWrite ValToStr(p = q) + ValToStr(p.trans = [10,20,3]);
    ! expect: TRUETRUE
    v := shared;
    v.x := 0;
    TPWrite ValToStr(shared);
    ! expect: [7,8,9]
    v := [v.y, v.x, v.z];
    TPWrite ValToStr(v);
    ! expect: [8,0,9]
    v := v;
    TPWrite ValToStr(v);
    ! expect: [8,0,9]
  ENDPROC
  PROC change(pos v)
    v.x := -1;
    v := [0,0,0];
  ENDPROC
  FUNC pose same(pose p)
    RETURN p;
  ENDFUNC
ENDMODULE
