!=== bytes_and_digits
MODULE bytes_and_digits
    ! source: [manual] S4 StrToByte, ByteToStr, NumToStr, DecToHex, HexToDec, StrDigCmp, StrDigCalc
    ! case:
    ! expect: 10 174 174 126 10 65
    ! expect: 122 0A 012 00001010 A
    ! expect: two characters
    ! expect: 0.385 3.85E-01 3 -3 1.00 1.0E+01 0.0E+00 0.0 3.00E+38
    ! expect: 5F5E0FF 99999999 7FFFFFFFFFFFFFFF
    ! expect: TRUE TRUE 4294967295 3
    ! expect: 11 bytes refused
    ! expect: NumToStr
    ! expect: DecToHex
    ! expect: too large
    ! expect: negative
    ! expect: by zero
    ! case: byte_to_str=code
    ! [manual] S4 datasys 3-ByteToStr by its word; [code] open_abb ends lines with ByteToStr(10\Char).
    ! expect: 10 174 174 126 10 65
    ! expect: 122 0A 012 00001010 A
    ! expect: two codes
    ! expect: 0.385 3.85E-01 3 -3 1.00 1.0E+01 0.0E+00 0.0 3.00E+38
    ! expect: 5F5E0FF 99999999 7FFFFFFFFFFFFFFF
    ! expect: TRUE TRUE 4294967295 3
    ! expect: 11 bytes refused
    ! expect: NumToStr
    ! expect: DecToHex
    ! expect: too large
    ! expect: negative
    ! expect: by zero
    VAR num refused := 0;
    PROC main()
        TPWrite ValToStr(StrToByte("10")) + " " + ValToStr(StrToByte("AE" \Hex)) + " " + ValToStr(StrToByte("ae" \Hex))
            + " " + ValToStr(StrToByte("176" \Okt)) + " " + ValToStr(StrToByte("00001010" \Bin)) + " "
            + ValToStr(StrToByte("A" \Char));
        TPWrite ByteToStr(122) + " " + ByteToStr(10 \Hex) + " " + ByteToStr(10 \Okt) + " " + ByteToStr(10 \Bin) + " "
            + ByteToStr(65 \Char);
        IF ByteToStr(7 \Char) = "\07" AND ByteToStr(10 \Char) = "\0A" TPWrite "two characters";
        IF ByteToStr(7 \Char) = "\\07" AND ByteToStr(10 \Char) = "\\0A" TPWrite "two codes";
        TPWrite NumToStr(0.38521, 3) + " " + NumToStr(0.38521, 2 \Exp) + " " + NumToStr(2.5, 0) + " " + NumToStr(-2.5, 0)
            + " " + NumToStr(1, 2) + " " + NumToStr(9.96, 1 \Exp) + " " + NumToStr(0, 1 \Exp) + " " + NumToStr(-0.001, 1)
            + " " + NumToStr(3E38, 2 \Exp);
        TPWrite DecToHex("99999999") + " " + HexToDec("5F5E0FF") + " " + DecToHex("9223372036854775807");
        TPWrite ValToStr(StrDigCmp("4294967295", GT, "4294967294")) + " " + ValToStr(StrDigCmp("1", EQ, "01")) + " "
            + StrDigCalc("4294967294", OpAdd, "1") + " " + StrDigCalc("7", OpMod, "4");
        no_bytes;
        TPWrite ValToStr(refused) + " bytes refused";
        others;
    ENDPROC
    PROC no_bytes()
        TPWrite ValToStr(StrToByte("256"));
        TPWrite ValToStr(StrToByte("1000"));
        TPWrite ValToStr(StrToByte(""));
        TPWrite ValToStr(StrToByte("100" \Hex));
        TPWrite ValToStr(StrToByte("400" \Okt));
        TPWrite ValToStr(StrToByte("8" \Okt));
        TPWrite ValToStr(StrToByte("2" \Bin));
        TPWrite ValToStr(StrToByte("ab" \Char));
        TPWrite ValToStr(StrToByte("\\07" \Char));
        TPWrite ValToStr(StrToByte("-1"));
        TPWrite ValToStr(StrToByte("1_0"));
    ERROR
        IF ERRNO = ERR_ARGVALERR refused := refused + 1;
        TRYNEXT;
    ENDPROC
    PROC others()
        TPWrite NumToStr(1, -1);
        TPWrite DecToHex("9223372036854775808");
        TPWrite StrDigCalc("4294967295", OpAdd, "1");
        TPWrite StrDigCalc("1", OpSub, "2");
        TPWrite StrDigCalc("1", OpDiv, "0");
    ERROR
        IF ERRNO = ERR_ARGVALERR AND refused = 12 TPWrite "DecToHex";
        IF ERRNO = ERR_ARGVALERR AND refused = 11 TPWrite "NumToStr";
        IF ERRNO = ERR_ARGVALERR refused := refused + 1;
        IF ERRNO = ERR_CALC_OVERFLOW TPWrite "too large";
        IF ERRNO = ERR_CALC_NEG TPWrite "negative";
        IF ERRNO = ERR_CALC_DIVZERO TPWrite "by zero";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== letters
MODULE letters
    ! source: [manual] S4 StrMap: what is not mapped is copied; S4 string: STR_LOWER has the letters of STR_UPPER and, last,
    ! two more, \DF and \FF; [code] loggers and readers of settings map STR_LOWER to STR_UPPER
    ! case:
    ! expect: ROBOT 1
    ! expect: robot 1
    ! expect: TRUE TRUE
    ! No capital stands for these two.
    ! expect: TRUE TRUE
    ! expect: xb
    PROC main()
        TPWrite StrMap("Robot 1", STR_LOWER, STR_UPPER);
        TPWrite StrMap("Robot 1", STR_UPPER, STR_LOWER);
        TPWrite ValToStr(StrMap("\E0\E5\F6\F8\FE", STR_LOWER, STR_UPPER) = "\C0\C5\D6\D8\DE") + " "
            + ValToStr(StrMap("\C0\C5\D6\D8\DE", STR_UPPER, STR_LOWER) = "\E0\E5\F6\F8\FE");
        TPWrite ValToStr(StrMap("\DF\FF", STR_LOWER, STR_UPPER) = "\DF\FF") + " "
            + ValToStr(StrMemb("\DF", 1, STR_LOWER) AND StrMemb("\FF", 1, STR_LOWER));
        TPWrite StrMap("ab", "ab", "x");
    ENDPROC
ENDMODULE
!=== num_text
MODULE num_text
    ! source: [manual] S4 ValToStr, TPWrite, NumToStr; exponents [mem]
    ! expect: 23
    ! expect: 1.14137
    ! expect: [1817.3,905.17,879.11]
    ! expect: TRUE
    ! expect: "text"
    ! expect: 0.123456789012345
    ! expect: 9E+09
    ! expect: n=0.3
    ! expect: d=0.1
    ! expect: p=[1,2,3]
    ! expect: 0.385 3.85E-01
    ! expect: 1
    ! expect: ERR_STRTOOLNG
    VAR num long{16} := [1.5,2.5,3.5,4.5,5.5,6.5,7.5,8.5,9.5,10.55,11.55,12.55,13.55,14.55,15.5555,16.5555];
    PERS num shared := 1;

    PROC main()
        VAR pos p := [1817.3,905.17,879.11];
        VAR dnum d := 0.123456789012345;
        VAR num n := 1.141367;
        TPWrite ValToStr(23);
        TPWrite ValToStr(n);
        TPWrite ValToStr(p);
        TPWrite ValToStr(TRUE);
        TPWrite ValToStr("text");
        TPWrite ValToStr(d);
        TPWrite ValToStr(9E9);
        TPWrite "n="\Num:=0.1 + 0.2;
        TPWrite "d="\Dnum:=0.1;
        TPWrite "p="\Pos:=[1,2,3];
        TPWrite NumToStr(0.38521, 3) + " " + NumToStr(0.38521, 2\Exp);
        TPWrite ValToStr(shared);
        TPWrite ValToStr(long);
    ERROR
        IF ERRNO = ERR_STRTOOLNG TPWrite "ERR_STRTOOLNG";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== split_string
MODULE split_string
    ! source: [manual] S4 StrFind, StrPart, StrLen: not found is length + 1; outside is an error; Machina [code]: right behind is not
    ! expect: alpha
    ! expect: 2
    ! expect: gamma
    ! expect: 4 4
    ! expect: outside
    ! expect: outside
    ! expect: outside
    PROC main()
        split "alpha,2,gamma";
        TPWrite ValToStr(StrFind("abc", 4, "x")) + " " + ValToStr(StrMatch("abc", 4, "xy"));
        TPWrite ValToStr(StrFind("abc", 5, "x"));
        TPWrite ValToStr(StrFind("abc", 0, "xy"));
        TPWrite ValToStr(StrMatch("abc", 5, "x"));
    ERROR
        IF ERRNO = ERR_OUTOFBND TPWrite "outside";
        TRYNEXT;
    ENDPROC

    PROC split(string line)
        VAR num start := 1;
        VAR num stop_at;
        WHILE start <= StrLen(line) DO
            stop_at := StrFind(line, start, ",");
            TPWrite StrPart(line, start, stop_at - start);
            start := stop_at + 1;
        ENDWHILE
    ENDPROC
ENDMODULE
!=== str_to_val
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
!=== string_parts
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
    ! case: find_past_end=error
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
!=== whole_all
MODULE whole_all
    ! source: S4 datasys 3-ValToStr-1 [manual]: 6 significant digits; Keyence's CV-X modules [code]
    ! dialect: whole_text=all
    ! expect: 3020000 1520989 [1,-1234567,0.5]
    ! expect: 1.67772E+07
    PROC main()
        VAR pos place := [1,-1234567,0.5];
        TPWrite ValToStr(3020000) + " " + ValToStr(1520989) + " " \Pos:=place;
        TPWrite ValToStr(16777216);
    ENDPROC
ENDMODULE
!=== whole_six
MODULE whole_six
    ! source: S4 datasys 3-ValToStr-1 [manual]: 6 significant digits; Keyence's CV-X modules [code]
    ! expect: 3.02E+06 1.52099E+06 [1,-1.23457E+06,0.5]
    ! expect: 1.67772E+07
    PROC main()
        VAR pos place := [1,-1234567,0.5];
        TPWrite ValToStr(3020000) + " " + ValToStr(1520989) + " " \Pos:=place;
        TPWrite ValToStr(16777216);
    ENDPROC
ENDMODULE
