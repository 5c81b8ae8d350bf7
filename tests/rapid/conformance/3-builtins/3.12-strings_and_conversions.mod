!=== bytetostr
! rule: arguments of ByteToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := ByteToStr(1);
        r_string := ByteToStr(1 \Hex);
        r_string := ByteToStr(1 \Okt);
        r_string := ByteToStr(1 \Bin);
        r_string := ByteToStr(1 \Char);
        r_string := ByteToStr();  ! -> RG311
        r_string := ByteToStr(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== dectohex
! rule: arguments of DecToHex
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := DecToHex("x");
        r_string := DecToHex();  ! -> RG311
        r_string := DecToHex("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== dnumtostr
! rule: arguments of DnumToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := DnumToStr(1, 1);
        r_string := DnumToStr(1, 1 \Exp);
        r_string := DnumToStr(1);  ! -> RG311
        r_string := DnumToStr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== hextodec
! rule: arguments of HexToDec
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := HexToDec("x");
        r_string := HexToDec();  ! -> RG311
        r_string := HexToDec("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== numtostr
! rule: arguments of NumToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := NumToStr(1, 1);
        r_string := NumToStr(1, 1 \Exp);
        r_string := NumToStr(1);  ! -> RG311
        r_string := NumToStr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strdigcalc
! rule: arguments of StrDigCalc
! source: [manual] 3HAC050917
MODULE Demo
    VAR stringdig r_stringdig;
    PROC main()
        r_stringdig := StrDigCalc("1", 1, "1");
        r_stringdig := StrDigCalc("1", 1);  ! -> RG311
        r_stringdig := StrDigCalc("1", 1, "1" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strdigcmp
! rule: arguments of StrDigCmp
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := StrDigCmp("1", 1, "1");
        r_bool := StrDigCmp("1", 1);  ! -> RG311
        r_bool := StrDigCmp("1", 1, "1" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strfind
! rule: arguments of StrFind
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrFind("x", 1, "x");
        r_num := StrFind("x", 1, "x" \NotInSet);
        r_num := StrFind("x", 1);  ! -> RG311
        r_num := StrFind("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strlen
! rule: arguments of StrLen
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrLen("x");
        r_num := StrLen();  ! -> RG311
        r_num := StrLen("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strmap
! rule: arguments of StrMap
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := StrMap("x", "x", "x");
        r_string := StrMap("x", "x");  ! -> RG311
        r_string := StrMap("x", "x", "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strmatch
! rule: arguments of StrMatch
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrMatch("x", 1, "x");
        r_num := StrMatch("x", 1);  ! -> RG311
        r_num := StrMatch("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strmemb
! rule: arguments of StrMemb
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := StrMemb("x", 1, "x");
        r_bool := StrMemb("x", 1);  ! -> RG311
        r_bool := StrMemb("x", 1, "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strorder
! rule: arguments of StrOrder
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := StrOrder("x", "x", "x");
        r_bool := StrOrder("x", "x");  ! -> RG311
        r_bool := StrOrder("x", "x", "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strpart
! rule: arguments of StrPart
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := StrPart("x", 1, 1);
        r_string := StrPart("x", 1);  ! -> RG311
        r_string := StrPart("x", 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strtobyte
! rule: arguments of StrToByte
! source: [manual] 3HAC050917
MODULE Demo
    VAR byte r_byte;
    PROC main()
        r_byte := StrToByte("x");
        r_byte := StrToByte("x" \Hex);
        r_byte := StrToByte("x" \Okt);
        r_byte := StrToByte("x" \Bin);
        r_byte := StrToByte("x" \Char);
        r_byte := StrToByte();  ! -> RG311
        r_byte := StrToByte("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== strtoval
! rule: arguments of StrToVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR bool r_bool;
    PROC main()
        r_bool := StrToVal("x", v_num);
        r_bool := StrToVal("x");  ! -> RG311
        r_bool := StrToVal("x", v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== valtostr
! rule: arguments of ValToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := ValToStr(1);
        r_string := ValToStr();  ! -> RG311
        r_string := ValToStr(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
