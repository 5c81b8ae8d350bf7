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
