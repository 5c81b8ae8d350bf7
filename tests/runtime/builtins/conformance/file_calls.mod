MODULE file_calls
    ! source: S4 datasys 2-Open, 2-Write, 3-ReadStr, 3-ReadNum, 3-ReadBin, 3-ReadStrBin [manual]; ReadStr's options, ReadAnyBin, raw bytes by 3HAC16581-1
    ! expect: n=0.25
    ! expect: p=[1,2,3]
    ! expect: EOF
    ! expect: 17 bytes
    ! expect: oldnew
    ! expect: EOF
    ! expect: -1
    ! expect: 97 98 99 100 101 -1
    ! expect: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx
    ! expect: xxxxxxxxxxxxxxxxxxxx
    ! expect: short
    ! expect: EOF
    ! expect: a
    ! expect: b
    ! expect: c
    ! expect: c
    ! expect: EOF
    ! expect: 12.5
    ! expect: no number
    ! expect: TRUE
    ! expect: he
    ! expect: 2: 6C
    ! expect: EOF
    ! expect: [1,2.5,3]
    ! expect: another type
    ! expect: end
    VAR iodev file;
    VAR string line;

    PROC main()
        lines;
        both_ways;
        pieces;
        numbers;
        values;
    ENDPROC

    PROC lines()
        Open "HOME:" \File:="log.txt", file \Write;
        Write file, "n="\Num:=0.25;
        Write file, "p="\Pos:=[1,2,3] \NoNewLine;
        Write file, "";
        Close file;
        Open "HOME:/log.txt", file \Read;
        FOR i FROM 1 TO 3 DO
            TPWrite ReadStr(file);
        ENDFOR
        Close file;
        TPWrite ValToStr(FileSize("HOME:/log.txt")) + " bytes";
    ENDPROC

    ! \Append goes on where the file ends; \Bin alone reads, and writes from the end.
    PROC both_ways()
        VAR num codes{3} := [99,100,7];
        Open "a", file \Write;
        Write file, "old" \NoNewLine;
        Close file;
        Open "a", file \Append;
        Write file, "new";
        Close file;
        Open "a", file \Read;
        TPWrite ReadStr(file);
        TPWrite ReadStr(file);
        Close file;
        Open "b", file \Write \Bin;
        WriteStrBin file, "ab";
        Close file;
        Open "HOME:/b", file \Bin;
        TPWrite ""\Num:=ReadBin(file);
        WriteBin file, codes, 2;
        WriteStrBin file, "e";
        Rewind file;
        line := "";
        FOR i FROM 1 TO 6 DO
            line := line + ValToStr(ReadBin(file)) + " ";
        ENDFOR
        TPWrite StrPart(line, 1, StrLen(line) - 1);
        Close file;
    ENDPROC

    PROC pieces()
        VAR string x := "xxxxxxxxxxxxxxxxxxxx";
        Open "a", file \Write;
        Write file, x + x + x + x \NoNewLine;
        Write file, x;
        Write file, "short";
        Close file;
        Open "a", file \Read;
        FOR i FROM 1 TO 4 DO
            TPWrite ReadStr(file);
        ENDFOR
        Close file;
        Open "a", file \Write \Bin;
        WriteStrBin file, ";;a;b\0D\0Ac";
        Close file;
        Open "a", file \Read;
        TPWrite ReadStr(file \Delim:=";" \DiscardHeaders);
        TPWrite ReadStr(file \RemoveCR);
        TPWrite ReadStr(file);
        TPWrite ReadStr(file \Line:=2);
        TPWrite ReadStr(file \Line:=9);
        Close file;
    ENDPROC

    PROC numbers()
        Open "a", file \Write;
        Write file, "12.5";
        Write file, " abc";
        Close file;
        Open "a", file \Read;
        TPWrite ""\Num:=ReadNum(file);
        TPWrite ""\Num:=ReadNum(file);
        TPWrite ""\Bool:=ReadNum(file) > 9.998E36;
        Close file;
    ERROR
        IF ERRNO = ERR_RCVDATA TPWrite "no number";
        TRYNEXT;
    ENDPROC

    PROC values()
        VAR rawbytes raw;
        VAR rawbytes back;
        VAR byte code;
        VAR pos place := [1,2.5,3];
        VAR pos found;
        VAR num n;
        PackRawBytes "hello", raw, 1 \ASCII;
        Open "a", file \Write \Bin;
        WriteRawBytes file, raw \NoOfBytes:=4;
        Close file;
        Open "a", file \Read \Bin;
        TPWrite ReadStrBin(file, 2);
        ReadRawBytes file, back;
        UnpackRawBytes back, 1, code \Hex1;
        UnpackRawBytes back, 2, n \Hex1;
        IF n = code TPWrite ValToStr(RawBytesLen(back)) + ": " + ByteToStr(code \Hex);
        TPWrite ReadStrBin(file, 2);
        Close file;
        line := "text";
        Open "a", file \Write \Bin;
        WriteAnyBin file, place;
        WriteAnyBin file, line;
        Close file;
        Open "a", file \Read \Bin;
        ReadAnyBin file, found;
        TPWrite ValToStr(found);
        ReadAnyBin file, n;
        ReadAnyBin file, n;
        Close file;
    ERROR
        IF ERRNO = ERR_RANYBIN_CHK TPWrite "another type";
        IF ERRNO = ERR_RANYBIN_EOF TPWrite "end";
        TRYNEXT;
    ENDPROC
ENDMODULE
