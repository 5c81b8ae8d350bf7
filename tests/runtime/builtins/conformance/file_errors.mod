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

    PROC told()
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
        told;
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
        told;
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
        told;
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
        told;
        TRYNEXT;
    ENDPROC
ENDMODULE
