! rule: names of errors: files
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_FILEOPEN;
        e := ERR_FILEACC;
        e := ERR_FILEEXIST;
        e := ERR_FILESIZE;
        e := ERR_FILNOTFND;
        e := ERR_IOERROR;
        e := ERR_LOADED;
        e := ERR_UNLOAD;
        e := ERR_NOTSAVED;
        e := ERR_MODULE;
        e := ERR_MOD_NOTLOADED;
        e := ERR_LINKREF;
        e := ERR_SYNTAX;
        e := ERR_PRGMEMFULL;
        e := ERR_LOADNO_INUSE;
        e := ERR_LOADNO_NOUSE;
        e := ERR_RANYBIN_CHK;
        e := ERR_RANYBIN_EOF;
        e := ERR_RCVDATA;
    ENDPROC
ENDMODULE
