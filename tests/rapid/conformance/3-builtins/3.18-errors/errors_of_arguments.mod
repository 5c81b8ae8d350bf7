! rule: names of errors: arguments
! source: [code] rapid-for-vim; [K §12]
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_OUTOFBND;
        e := ERR_NOTARR;
        e := ERR_ILLDIM;
        e := ERR_INVDIM;
        e := ERR_NOTEQDIM;
        e := ERR_ARRAY_SIZE;
        e := ERR_NOTPRES;
        e := ERR_INPAR_RDONLY;
        e := ERR_ARGDUPCND;
        e := ERR_ARGNAME;
        e := ERR_ARGNOTPER;
        e := ERR_ARGNOTVAR;
        e := ERR_REFUNKDAT;
        e := ERR_REFUNKFUN;
        e := ERR_REFUNKPRC;
        e := ERR_REFUNKTRP;
        e := ERR_UNKPROC;
        e := ERR_CALLPROC;
        e := ERR_FNCNORET;
        e := ERR_ILLRAISE;
        e := ERR_EXCRTYMAX;
        e := ERR_NOT_VALID_RECOVER_ACTION;
        e := ERR_EXECPHR;
    ENDPROC
ENDMODULE
