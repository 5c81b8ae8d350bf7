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
