!=== arg_name
MODULE arg_name
! source: [S4 datasys 3-ArgName-1..3] the original datum's name, through any number of calls
  VAR num original := 1;
  VAR num list{3} := [1,2,3];
  VAR pos where := [1,2,3];
  PROC main()
    outer original;
    outer list{2};
    outer where.y;
    outer 1 + 2;
    ! expect: original
    ! expect: list
    ! expect: where
    ! expect: no name
  ENDPROC
  PROC outer(num first)
    inner first;
  ENDPROC
  PROC inner(num second)
    TPWrite ArgName(second);
  ERROR
    IF ERRNO = ERR_ARGNAME TPWrite "no name";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== arrays_by_value
MODULE arrays_by_value
! source: [K §2.17, 3.5, 4.4] arrays are copied whole; sizes must be equal: ERR_NOTEQDIM
! dialect: unhandled_error=propagate
  VAR num a{3} := [1,2,3];
  CONST num SIZE := 2;
  VAR num m{SIZE,SIZE+1} := [[1,2,3],[4,5,6]];
  PROC main()
    VAR num b{3};
    b := a;
    b{1} := 9;
    TPWrite ValToStr(a) + ValToStr(b) + ValToStr(a = b);
    ! expect: [1,2,3][9,2,3]FALSE
    fill b, 4;
    TPWrite ValToStr(b) + " " + ValToStr(sum(b)) + ValToStr(sum(a));
    ! expect: [4,4,4] 126
    TPWrite ValToStr(Dim(m,1)) + ValToStr(Dim(m,2)) + ValToStr(m{2,1});
    ! expect: 234
    change a;
    TPWrite ValToStr(a);
    ! expect: [1,2,3]
    two a;
    ! expect: sizes differ
    a := [a{3}, a{2}, a{1}];
    TPWrite ValToStr(a);
    ! expect: [3,2,1]
  ERROR
    IF ERRNO = ERR_NOTEQDIM TPWrite "sizes differ";
    TRYNEXT;
  ENDPROC
  PROC fill(VAR num list{*}, num value)
    FOR i FROM 1 TO Dim(list,1) DO
      list{i} := value;
    ENDFOR
  ENDPROC
  FUNC num sum(num list{*})
    VAR num total;
    FOR i FROM 1 TO Dim(list,1) DO
      total := total + list{i};
    ENDFOR
    RETURN total;
  ENDFUNC
  PROC change(num list{*})
    list{1} := 77;
  ENDPROC
  PROC two(num list{*})
    VAR num own{2};
    own := list;
  ENDPROC
ENDMODULE
!=== comparisons
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
!=== constants
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
!=== defaults
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
!=== div_floor
MODULE div_floor
! source: [mem] switch integer_division=floor
! dialect: integer_division=floor
  PROC main()
    VAR num n := -7;
    TPWrite ValToStr(n DIV 2) + " " + ValToStr(n MOD 2);
    ! expect: -4 1
  ENDPROC
ENDMODULE
!=== div_mod
MODULE div_mod
! source: [K §3.11, 12] whole operands, divisor of MOD not negative; [mem] DIV goes towards zero
  PROC main()
    VAR num z;
    VAR num n := -7;
    TPWrite ValToStr(14 DIV 4) + " " + ValToStr(14 MOD 4);
    ! expect: 3 2
    TPWrite ValToStr(n DIV 2) + " " + ValToStr(n MOD 2);
    ! expect: -3 -1
    TPWrite ValToStr(7 DIV (-2));
    ! expect: -3
    z := 1 DIV 0;
    ! expect: DIVZERO
    z := 1 MOD 0;
    ! expect: DIVZERO
    z := 1.5 DIV 1;
    ! expect: NOTINTVAL
    z := 5 MOD (-2);
    ! expect: NEGARG
    TPWrite ValToStr(z);
    ! expect: 0
  ERROR
    IF ERRNO = ERR_DIVZERO TPWrite "DIVZERO";
    IF ERRNO = ERR_NOTINTVAL TPWrite "NOTINTVAL";
    IF ERRNO = ERR_NEGARG TPWrite "NEGARG";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== dnum_whole
MODULE dnum_whole
    ! source: [mem] a dnum counts whole numbers to 2^52; as an IEEE double it would to 2^53
    ! case:
    ! expect: lost
    ! expect: TRUE TRUE TRUE TRUE TRUE TRUE
    ! case: dnum_whole=53
    ! expect: counted
    ! expect: FALSE FALSE TRUE TRUE TRUE TRUE
    CONST dnum BEYOND_52 := 4503599627370497;
    VAR dnum list{2} := [4503599627370497, 9007199254740993];
    PROC main()
        VAR dnum large := 4503599627370496;
        VAR dnum small := 1;
        VAR dnum product;
        VAR dnum stepped := 9007199254740992;

        product := 2 * large - small;
        IF product - large = large - small THEN
            TPWrite "counted";
        ELSE
            TPWrite "lost";
        ENDIF
        Incr stepped;
        TPWrite same(BEYOND_52, large) + same(list{1}, large) + same(list{2}, 2 * large)
            + same(9007199254740993, 2 * large) + same(stepped, 2 * large)
            + ValToStr(large * 2 + 1 = 2 * large);
    ENDPROC
    FUNC string same(dnum one, dnum other)
        RETURN ValToStr(one = other) + " ";
    ENDFUNC
ENDMODULE
!=== incr
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
!=== inout_mismatch
MODULE inout_mismatch
! source: [K §5.1, 12] an INOUT parameter passed on as VAR or PERS is checked when it happens
! dialect: unhandled_error=propagate
  PERS num p := 1;
  PROC main()
    VAR num l := 1;
    as_var l;
    as_var p;
    as_pers l;
    as_pers p;
    TPWrite ValToStr(l) + " " + ValToStr(p);
    ! expect: NOTVAR
    ! expect: NOTPER
    ! expect: 2 3
  ERROR
    IF ERRNO = ERR_ARGNOTVAR TPWrite "NOTVAR";
    IF ERRNO = ERR_ARGNOTPER TPWrite "NOTPER";
    TRYNEXT;
  ENDPROC
  PROC as_var(INOUT num n)
    var_ n;
  ENDPROC
  PROC as_pers(INOUT num n)
    pers_ n;
  ENDPROC
  PROC var_(VAR num n)
    n := n + 1;
  ENDPROC
  PROC pers_(PERS num n)
    n := n + 2;
  ENDPROC
ENDMODULE
!=== mod_negative
MODULE mod_negative
! source: [S4 overview 4-26] switch negative_mod=error
! dialect: negative_mod=error
! fault: ERR_NEGARG 7
  PROC main()
    VAR num n := -7;
    n := n MOD 2;
  ENDPROC
ENDMODULE
!=== num_is_single
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
!=== overflow
MODULE overflow
! source: [K §1.4, 2.13] a num does not go beyond IEEE single; ERR_NUM_LIMIT [mem]
  PROC main()
    VAR num x := 1E38;
    VAR num n := 0;
    x := x * 10;
    TPWrite ValToStr(x);
    WHILE n < 5 DO
      x := x + x;
      Incr n;
    ENDWHILE
    TPWrite "end";
    ! expect: limit
    ! expect: 1E+38
    ! expect: limit
    ! expect: limit
    ! expect: limit
    ! expect: limit
    ! expect: end
  ERROR
    IF ERRNO = ERR_NUM_LIMIT TPWrite "limit";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== parameter_modes
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
!=== precedence
MODULE precedence
! source: [K §3] * / DIV MOD, + -, relations, AND, then OR XOR NOT; left to right
  PROC main()
    TPWrite ValToStr(2 + 3 * 4) + " " + ValToStr(20 - 5 - 3) + " " + ValToStr(24 / 4 / 2);
    ! expect: 14 12 3
    TPWrite ValToStr(-2 * 3) + " " + ValToStr(-2 + 5) + " " + ValToStr(7 - 2 * 3 + 1);
    ! expect: -6 3 2
    TPWrite ValToStr(TRUE OR FALSE AND FALSE);
    ! expect: TRUE
    TPWrite ValToStr(NOT FALSE AND FALSE);
    ! expect: TRUE
    TPWrite ValToStr(NOT 1 = 2);
    ! expect: TRUE
    TPWrite ValToStr(1 + 1 = 2 AND 2 < 3);
    ! expect: TRUE
  ENDPROC
ENDMODULE
!=== records_by_value
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
!=== reflection
MODULE reflection
! source: [K §11, S4 datasys 3-Present-1, 3-Dim-1, 3-IsPers-1] what a routine can ask of its arguments
  PERS num kept := 1;
  VAR num plain := 1;
  VAR num table{2,5};
  PROC main()
    ask kept;
    ask plain;
    ask plain \flag;
    ask plain \opt:=3;
    sizes table;
    ! expect: pers FALSEFALSETRUE
    ! expect: var FALSEFALSETRUE
    ! expect: var TRUEFALSETRUE
    ! expect: var FALSETRUETRUE
    ! expect: 2 5
    ! expect: no dimension 3
  ENDPROC
  PROC ask(INOUT num v \switch flag \num opt)
    VAR string kind := "?";
    IF IsPers(v) kind := "pers ";
    IF IsVar(v) kind := "var ";
    TPWrite kind + ValToStr(Present(flag)) + ValToStr(Present(opt)) + ValToStr(Present(v));
  ENDPROC
  PROC sizes(num a{*,*})
    TPWrite ValToStr(Dim(a,1)) + " " + ValToStr(Dim(a,2));
    TPWrite ValToStr(Dim(a,3));
  ERROR
    IF ERRNO = ERR_ILLDIM TPWrite "no dimension 3";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== rounding_each_operation
MODULE rounding_each_operation
! source: [mem] switch num_rounding=operation
! dialect: num_rounding=operation
  PROC main()
    VAR num x;
    x := 1 / 3;
    TPWrite ValToStr(x = 1 / 3);
    ! expect: TRUE
  ENDPROC
ENDMODULE
!=== scope
MODULE scope
! source: [K §2.20] routine data hide module data hide built-in objects; names have no case
  VAR num Value := 1;
  CONST num pi := 3;
  PROC main()
    VAR num VALUE := 2;
    tpwrite valtostr(value) + " " + ValToStr(PI) + " " + ValToStr(OUTER());
    ! expect: 2 3 1
  ENDPROC
  FUNC num outer()
    RETURN Value;
  ENDFUNC
  FUNC num Abs(num x)
    RETURN 42;
  ENDFUNC
ENDMODULE
!=== strings
MODULE strings
! source: [K §2.13, 3.11] at most 80 characters, ERR_STRTOOLNG; comparison counts case
  PROC main()
    VAR string s := "0123456789012345678901234567890123456789";
    VAR string t;
    t := s + s;
    TPWrite ValToStr(StrLen(t));
    ! expect: 80
    t := t + "x";
    ! expect: too long
    TPWrite ValToStr(StrLen(t)) + ValToStr("a" = "A") + ValToStr("" = t);
    ! expect: 80FALSEFALSE
    TPWrite "\41\\""";
    ! expect: A\"
  ERROR
    IF ERRNO = ERR_STRTOOLNG TPWrite "too long";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== subnormal
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
!=== user_records
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
!=== vector_operators
MODULE vector_operators
! source: [K §3.11, S4 overview 4-26] pos+pos, pos-pos, -pos, num*pos, pos*num, pos*pos, orient*orient
! source: [backup] pos/num: programs of a running cell with RobotWare 6
  PROC main()
    VAR pos a := [1,2,3];
    VAR pos b := [0,1,0];
    VAR orient r := [0.70710677,0,0,0.70710677];
    TPWrite ValToStr(a + b) + ValToStr(a - b) + ValToStr(-a) + ValToStr(2 * a) + ValToStr(a * 2);
    ! expect: [1,3,3][1,1,3][-1,-2,-3][2,4,6][2,4,6]
    TPWrite ValToStr(a * b) + ValToStr(a + [1,1,1]);
    ! expect: [-3,0,1][2,3,4]
    TPWrite ValToStr((a + b) / 2);
    ! expect: [0.5,1.5,1.5]
    a := a / (b.x * 0);
    ! expect: divided by 0
    r := r * r;
    TPWrite NumToStr(r.q1,3) + " " + NumToStr(r.q4,3);
    ! expect: 0.000 1.000
    TPWrite ValToStr(Twice([9, 8, 7] - [1, 2, 3]));
    ! expect: [16,12,8]
  ERROR
    TPWrite "divided by " + NumToStr(b.x,0);
    TRYNEXT;
  ENDPROC
  FUNC pos Twice(pos v)
    RETURN 2 * v;
  ENDFUNC
ENDMODULE
!=== whole_overflow
MODULE whole_overflow
! source: [K §2.13] a num is an IEEE single, also one that has only whole values; ERR_NUM_LIMIT [mem]
  PROC main()
    VAR num n := 1;
    VAR num passes := 0;
    WHILE passes < 40 DO
      n := n * 10;
      passes := passes + 1;
    ENDWHILE
    TPWrite ValToStr(n);
    n := n + n + n + n;
    TPWrite ValToStr(n);
    n := 16777215;
    Incr n;
    Incr n;
    Incr n;
    TPWrite ValToStr(n = 16777216);
    ! expect: limit
    ! expect: limit
    ! expect: 1E+38
    ! expect: limit
    ! expect: 1E+38
    ! expect: TRUE
  ERROR
    IF ERRNO = ERR_NUM_LIMIT TPWrite "limit";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== whole_rounding_at_store
MODULE whole_rounding_at_store
! source: [mem] switch num_rounding=store: an expression keeps more digits than a num
  PROC main()
    VAR num big := 16777216;
    VAR num one := 1;
    VAR num sum;
    TPWrite ValToStr(big + one - big);
    sum := big + one;
    TPWrite ValToStr(sum - big);
    ! expect: 1
    ! expect: 0
  ENDPROC
ENDMODULE
!=== whole_rounding_each_operation
MODULE whole_rounding_each_operation
! source: [mem] switch num_rounding=operation: 16777216 + 1 is 16777216 as a single
! dialect: num_rounding=operation
  PROC main()
    VAR num big := 16777216;
    VAR num one := 1;
    TPWrite ValToStr(big + one = big);
    TPWrite ValToStr(big + one - big);
    TPWrite ValToStr(big * 2 + one - big * 2);
    TPWrite ValToStr(one + one + one = 3);
    ! expect: TRUE
    ! expect: 0
    ! expect: 0
    ! expect: TRUE
  ENDPROC
ENDMODULE
