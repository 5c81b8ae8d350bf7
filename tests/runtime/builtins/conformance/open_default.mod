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
