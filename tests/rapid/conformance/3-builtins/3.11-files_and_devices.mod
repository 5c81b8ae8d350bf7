!=== cleariobuff
! rule: arguments of ClearIOBuff
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        ClearIOBuff v_iodev;
        ClearIOBuff;  ! -> RG311?
        ClearIOBuff v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== close
! rule: arguments of Close
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Close v_iodev;
        Close;  ! -> RG311?
        Close v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== closedir
! rule: arguments of CloseDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    PROC main()
        CloseDir v_dir;
        CloseDir;  ! -> RG311?
        CloseDir v_dir \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== copyfile
! rule: arguments of CopyFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CopyFile "x", "x";
        CopyFile "x";  ! -> RG311
        CopyFile "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== filesize
! rule: arguments of FileSize
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := FileSize("x");
        r_num := FileSize();  ! -> RG311
        r_num := FileSize("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== filetime
! rule: arguments of FileTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR stringdig v_stringdig;
    PROC main()
        r_num := FileTime("x");
        r_num := FileTime("x" \ModifyTime \StrDig:=v_stringdig);
        r_num := FileTime("x" \AccessTime \StrDig:=v_stringdig);
        r_num := FileTime("x" \StatCTime \StrDig:=v_stringdig);
        r_num := FileTime();  ! -> RG311
        r_num := FileTime("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== fssize
! rule: arguments of FSSize
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := FSSize("x");
        r_num := FSSize("x" \Total \Kbyte \Mbyte);
        r_num := FSSize("x" \Free \Kbyte \Mbyte);
        r_num := FSSize();  ! -> RG311
        r_num := FSSize("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== isfile
! rule: arguments of IsFile
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsFile("x");
        r_bool := IsFile("x" \Directory);
        r_bool := IsFile("x" \Fifo);
        r_bool := IsFile("x" \RegFile);
        r_bool := IsFile("x" \BlockSpec);
        r_bool := IsFile("x" \CharSpec);
        r_bool := IsFile();  ! -> RG311
        r_bool := IsFile("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== makedir
! rule: arguments of MakeDir
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MakeDir "x";
        MakeDir;  ! -> RG311?
        MakeDir "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== open
! rule: arguments of Open
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Open "x", v_iodev;
        Open "x" \File:="x", v_iodev \Read \Bin;
        Open "x" \File:="x", v_iodev \Write \Bin;
        Open "x" \File:="x", v_iodev \Append \Bin;
        Open "x";  ! -> RG311
        Open "x", v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== opendir
! rule: arguments of OpenDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    PROC main()
        OpenDir v_dir, "x";
        OpenDir v_dir;  ! -> RG311
        OpenDir v_dir, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readanybin
! rule: arguments of ReadAnyBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num v_num;
    PROC main()
        ReadAnyBin v_iodev, v_num;
        ReadAnyBin v_iodev, v_num \Time:=1;
        ReadAnyBin v_iodev;  ! -> RG311
        ReadAnyBin v_iodev, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readbin
! rule: arguments of ReadBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num r_num;
    PROC main()
        r_num := ReadBin(v_iodev);
        r_num := ReadBin(v_iodev \Time:=1);
        r_num := ReadBin();  ! -> RG311
        r_num := ReadBin(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readdir
! rule: arguments of ReadDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    VAR string v_string;
    VAR bool r_bool;
    PROC main()
        r_bool := ReadDir(v_dir, v_string);
        r_bool := ReadDir(v_dir);  ! -> RG311
        r_bool := ReadDir(v_dir, v_string \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readnum
! rule: arguments of ReadNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num r_num;
    PROC main()
        r_num := ReadNum(v_iodev);
        r_num := ReadNum(v_iodev \Delim:="x" \Time:=1);
        r_num := ReadNum();  ! -> RG311
        r_num := ReadNum(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readstr
! rule: arguments of ReadStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR string r_string;
    PROC main()
        r_string := ReadStr(v_iodev);
        r_string := ReadStr(v_iodev \Delim:="x" \RemoveCR \DiscardHeaders \Time:=1 \Line:=1);
        r_string := ReadStr();  ! -> RG311
        r_string := ReadStr(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== readstrbin
! rule: arguments of ReadStrBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR string r_string;
    PROC main()
        r_string := ReadStrBin(v_iodev, 1);
        r_string := ReadStrBin(v_iodev, 1 \Time:=1);
        r_string := ReadStrBin(v_iodev);  ! -> RG311
        r_string := ReadStrBin(v_iodev, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== removedir
! rule: arguments of RemoveDir
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveDir "x";
        RemoveDir;  ! -> RG311?
        RemoveDir "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== removefile
! rule: arguments of RemoveFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveFile "x";
        RemoveFile;  ! -> RG311?
        RemoveFile "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== renamefile
! rule: arguments of RenameFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RenameFile "x", "x";
        RenameFile "x";  ! -> RG311
        RenameFile "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== rewind
! rule: arguments of Rewind
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Rewind v_iodev;
        Rewind;  ! -> RG311?
        Rewind v_iodev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== write
! rule: arguments of Write
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        Write v_iodev, "x";
        Write v_iodev, "x" \Num:=1 \NoNewLine;
        Write v_iodev, "x" \Bool:=TRUE \NoNewLine;
        Write v_iodev, "x" \Pos:=[1, 2, 3] \NoNewLine;
        Write v_iodev, "x" \Orient:=[1, 0, 0, 0] \NoNewLine;
        Write v_iodev, "x" \Dnum:=1 \NoNewLine;
        Write v_iodev;  ! -> RG311
        Write v_iodev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writeanybin
! rule: arguments of WriteAnyBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        WriteAnyBin v_iodev, 1;
        WriteAnyBin v_iodev;  ! -> RG311
        WriteAnyBin v_iodev, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writebin
! rule: arguments of WriteBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num v_num_array{2};
    PROC main()
        WriteBin v_iodev, v_num_array, 1;
        WriteBin v_iodev, v_num_array;  ! -> RG311
        WriteBin v_iodev, v_num_array, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writestrbin
! rule: arguments of WriteStrBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    PROC main()
        WriteStrBin v_iodev, "x";
        WriteStrBin v_iodev;  ! -> RG311
        WriteStrBin v_iodev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
