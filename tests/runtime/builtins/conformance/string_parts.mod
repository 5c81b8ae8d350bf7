MODULE string_parts
    ! source: [manual] S4 StrPart, StrFind, StrMatch, StrMap, StrMemb, StrOrder, StrFormat; [code] Machina looks right behind
    ! dialect: unhandled_error=propagate
    ! case:
    ! expect: Robot s
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! Nothing found is length + 1.
    ! expect: 2 1 2 8 9
    ! expect: 3 3 9 9
    ! expect: 9 9 1 1
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: RObOtIcs TRUE FALSE
    ! Characters without a rank come behind all that have one.
    ! expect: TRUE TRUE FALSE FALSE
    ! expect: a: b
    ! case: find_behind=error
    ! expect: Robot s
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: 2 1 2 8 9
    ! expect: 3 3 9 9
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: outside
    ! expect: RObOtIcs TRUE FALSE
    ! expect: TRUE TRUE FALSE FALSE
    ! expect: a: b
    CONST string letters := "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    VAR string s := "Robotics";
    PROC main()
        TPWrite StrPart(s, 1, 5) + " " + StrPart(s, 8, 1) + StrPart(s, 3, 0);
        TPWrite StrPart(s, 0, 1);
        TPWrite StrPart(s, 9, 1);
        TPWrite StrPart(s, 8, 2);
        TPWrite StrPart(s, 1, -1);
        TPWrite StrPart(s, 1.5, 1);
        TPWrite found(1, "aeiou") + " " + ValToStr(StrFind(s, 1, "aeiou" \NotInSet)) + " " + found(2, "aeiou")
            + " " + found(8, "s") + " " + found(3, "xyz");
        TPWrite matched(3, "bo") + " " + matched(1, "bo") + " " + matched(1, "BO") + " " + matched(4, "bo");
        IF StrFind(s, 9, "x") = 9 AND StrFind("", 1, "x") = 1 AND StrMatch(s, 9, "x") = 9 AND StrMatch("", 1, "x") = 1
            TPWrite "9 9 1 1";
        behind;
        TPWrite found(0, "x");
        TPWrite found(10, "x");
        TPWrite found(1.5, "x");
        TPWrite matched(0, "x");
        TPWrite matched(10, "x");
        TPWrite matched(1.5, "x");
        TPWrite StrMap(s, "aeiou", "AEIOU") + " " + ValToStr(StrMemb(s, 2, "aeiou")) + " "
            + ValToStr(StrMemb(s, 3, "aeiou"));
        TPWrite ValToStr(StrOrder("FIRST", "SECOND", letters)) + " " + ValToStr(StrOrder("FIRST", "FIRST", letters))
            + " " + ValToStr(StrOrder("FIRST", "FIR", letters)) + " " + ValToStr(StrOrder("a", "Z", letters));
        TPWrite StrFormat("{1}: {2}" \Arg1:="a" \Arg2:="b");
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "outside";
        TRYNEXT;
    ENDPROC
    PROC behind()
        ! Only by the manual's word is this an error, here and above.
        IF StrFind(s, 9, "x") = 0 TPWrite "never";
        IF StrMatch(s, 9, "x") = 0 TPWrite "never";
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "outside";
        TRYNEXT;
    ENDPROC
    FUNC string found(num place, string set)
        RETURN ValToStr(StrFind(s, place, set));
    ENDFUNC
    FUNC string matched(num place, string pattern)
        RETURN ValToStr(StrMatch(s, place, pattern));
    ENDFUNC
ENDMODULE
