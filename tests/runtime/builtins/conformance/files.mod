!=== delimiters
MODULE delimiters
    ! source: [mem] RobotWare 6 manual, ReadStr: the delimiters, and the line feed by default
    ! case:
    ! expect: a|b|c|d|
    ! case: delimiters=alone
    ! expect: a|b_c|d_|EOF|
    PROC main()
        VAR iodev file;
        VAR string all;
        Open "HOME:" \File:="list.txt", file \Write;
        Write file, "a;b";
        Write file, "c;d";
        Close file;
        Open "HOME:" \File:="list.txt", file \Read;
        FOR i FROM 1 TO 4 DO
            all := all + ReadStr(file \Delim:=";") + "|";
        ENDFOR
        TPWrite StrMap(all, "\0A", "_");
    ENDPROC
ENDMODULE
!=== file_calls
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
!=== file_errors
MODULE file_errors
    ! source: S4 datasys 2-Open (a mode that does not fit), 2-MakeDir, 3-ReadDir, 2-CopyFile, 2-RenameFile [manual]
    ! expect: access
    ! expect: access
    ! expect: access
    ! expect: access
    ! expect: open
    ! expect: access
    ! expect: access
    ! expect: access
    ! expect: access
    ! expect: access
    ! expect: entry .
    ! expect: entry ..
    ! expect: entry one
    ! expect: access
    ! expect: access
    ! expect: FALSE
    ! expect: access
    ! expect: size 4
    ! expect: moved FALSE
    ! expect: exists
    ! expect: exists
    VAR iodev file;
    VAR dir folder;
    VAR string text;
    VAR num n;

    PROC main()
        wrong_mode;
        not_there;
        folders;
        copies;
    ENDPROC

    PROC logged()
        TEST ERRNO
        CASE ERR_FILEACC:
            TPWrite "access";
        CASE ERR_FILEOPEN:
            TPWrite "open";
        CASE ERR_FILEEXIST:
            TPWrite "exists";
        ENDTEST
    ENDPROC

    PROC wrong_mode()
        Open "a", file \Write;
        text := ReadStr(file);
        Close file;
        Open "a", file \Read;
        Write file, "x";
        n := ReadBin(file);
        Close file;
        Open "a", file \Write;
        WriteStrBin file, "x";
        Close file;
    ERROR
        logged;
        TRYNEXT;
    ENDPROC

    PROC not_there()
        VAR iodev closed;
        Open "none", file \Read;
        n := FileSize("none");
        n := FileTime("none" \ModifyTime);
        RemoveFile "none";
        RemoveDir "none";
        text := ReadStr(closed);
        Close closed;
    ERROR
        logged;
        TRYNEXT;
    ENDPROC

    PROC folders()
        MakeDir "HOME:/d";
        Open "HOME:/d/one", file \Write;
        Close file;
        OpenDir folder, "HOME:/d";
        WHILE ReadDir(folder, text) DO
            TPWrite "entry " + text;
        ENDWHILE
        CloseDir folder;
        IF ReadDir(folder, text) TPWrite "wrong";
        RemoveDir "HOME:/d";
        RemoveFile "HOME:/d/one";
        RemoveDir "HOME:/d";
        TPWrite ""\Bool:=IsFile("HOME:/d");
        RemoveDir "HOME:";
    ERROR
        logged;
        TRYNEXT;
    ENDPROC

    PROC copies()
        Open "c", file \Write;
        Write file, "abc";
        Close file;
        CopyFile "c", "TEMP:/b";
        TPWrite "size "\Num:=FileSize("TEMP:/b");
        RenameFile "c", "e";
        TPWrite "moved "\Bool:=IsFile("c");
        Open "f", file \Write;
        Close file;
        CopyFile "e", "f";
        RenameFile "e", "f";
    ERROR
        logged;
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== files
MODULE files
    ! source: [manual] S4 Open, Write, ReadStr, ReadNum, ReadBin; end of file by constants
    ! expect: x=1.5
    ! expect: 42
    ! expect: EOF
    ! expect: 3
    ! expect: -1
    ! expect: there
    ! expect: no way out
    ! expect: gone
    PROC main()
        VAR iodev file;
        VAR string line;
        VAR num n;
        Open "HOME:" \File:="log.txt", file \Write;
        Write file, "x="\Num:=1.5;
        Write file, "42";
        Close file;
        Open "HOME:/log.txt", file \Read;
        TPWrite ReadStr(file);
        TPWrite ValToStr(ReadNum(file));
        line := ReadStr(file);
        IF line = EOF TPWrite line;
        Close file;
        Open "TEMP:/bytes", file \Write \Bin;
        WriteStrBin file, "\03";
        Close file;
        Open "TEMP:/bytes", file \Read \Bin;
        TPWrite ValToStr(ReadBin(file));
        n := ReadBin(file);
        IF n = EOF_BIN TPWrite ValToStr(n);
        Close file;
        Close file;
        IF IsFile("home:/LOG.TXT") TPWrite "there";
        Open "HOME:/../../etc/passwd", file \Read;
        RemoveFile "HOME:/log.txt";
        IF NOT IsFile("HOME:/log.txt") TPWrite "gone";
    ERROR
        IF ERRNO = ERR_FILEACC TPWrite "no way out";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== open_default
MODULE open_default
    ! source: S4 datasys 2-Open: no switch means \Write, which empties the file; or \Read (switch `open_default`)
    ! case: open_default=write
    ! expect: size 0
    ! expect: not for reading
    ! case: open_default=read
    ! expect: size 4
    ! expect: old
    PROC main()
        VAR iodev file;
        Open "HOME:/a", file \Write;
        Write file, "old";
        Close file;
        Open "HOME:/a", file;
        TPWrite "size "\Num:=FileSize("HOME:/a");
        TPWrite ReadStr(file);
    ERROR
        IF ERRNO = ERR_FILEACC TPWrite "not for reading";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== read_status
MODULE read_status
    ! source: a public template for palletising [code]: \Status, and the text REMAIN where a line goes on
    ! expect: 80,REMAIN
    ! expect: 20,
    ! expect: 80,
    ! expect: 0,
    PROC main()
        VAR iodev file;
        VAR string text;
        VAR string status;
        VAR string ten := "0123456789";
        VAR string forty;
        forty := ten + ten + ten + ten;
        Open "HOME:/a", file \Write;
        Write file, forty \NoNewLine;
        Write file, forty \NoNewLine;
        Write file, ten + ten;
        Write file, forty \NoNewLine;
        Write file, forty;
        Close file;
        Open "HOME:/a", file \Read;
        FOR i FROM 1 TO 4 DO
            text := ReadStr(file \RemoveCR \Status:=status);
            TPWrite ValToStr(StrLen(text)) + "," + status;
        ENDFOR
        Close file;
    ENDPROC
ENDMODULE
