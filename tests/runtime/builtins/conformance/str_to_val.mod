MODULE str_to_val
    ! source: [manual] S4 StrToVal: FALSE leaves the target as it was, no error
    ! expect: TRUE 3.85
    ! expect: TRUE [600,500,225.3]
    ! expect: FALSE [600,500,225.3]
    ! expect: TRUE [1,2]
    ! expect: TRUE 7
    ! expect: FALSE text
    ! expect: TRUE quoted
    RECORD pair
        num a;
        num b;
    ENDRECORD
    PERS num kept := 0;

    PROC main()
        VAR num n;
        VAR pos p;
        VAR pair q;
        VAR bool ok;
        VAR string s := "text";
        ok := StrToVal("3.85", n);
        TPWrite ValToStr(ok) + " " + ValToStr(n);
        ok := StrToVal("[600, 500, 225.3]", p);
        TPWrite ValToStr(ok) + " " + ValToStr(p);
        ok := StrToVal("[1,2]", p);
        TPWrite ValToStr(ok) + " " + ValToStr(p);
        ok := StrToVal("[1,2]", q);
        TPWrite ValToStr(ok) + " " + ValToStr(q);
        ok := StrToVal("7", kept);
        TPWrite ValToStr(ok) + " " + ValToStr(kept);
        ok := StrToVal("no quotes", s);
        TPWrite ValToStr(ok) + " " + s;
        ok := StrToVal("""quoted""", s);
        TPWrite ValToStr(ok) + " " + s;
    ENDPROC
ENDMODULE
