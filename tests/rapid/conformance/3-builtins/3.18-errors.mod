!=== errors_are_constants
! rule: names of errors are constants of type errnum
! source: [K §12]
! given: system
MODULE Demo
    VAR string s;
    PROC main()
        ERR_DIVZERO := 1;  ! -> RG310
        s := ERR_DIVZERO;  ! -> RG307
    ENDPROC
ENDMODULE
!=== errors_of_arguments
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
!=== errors_of_files
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
!=== errors_of_interrupts
! rule: names of errors: interrupts
! source: [code] rapid-for-vim; [K §12]
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_ALRDYCNT;
        e := ERR_CNTNOTVAR;
        e := ERR_INOMAX;
        e := ERR_UNKINO;
        e := ERR_INOISSAFE;
    ENDPROC
ENDMODULE
!=== errors_of_messages
! rule: names of errors: messages
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_RMQ_NAME;
        e := ERR_RMQ_FULL;
        e := ERR_RMQ_INVALID;
        e := ERR_RMQ_INVMSG;
        e := ERR_RMQ_NOMSG;
        e := ERR_RMQ_TIMEOUT;
        e := ERR_RMQ_VALUE;
        e := ERR_RMQ_DIM;
        e := ERR_RMQ_MSGSIZE;
    ENDPROC
ENDMODULE
!=== errors_of_motion
! rule: names of errors: motion
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_PATH_STOP;
        e := ERR_COLL_STOP;
        e := ERR_PATHDIST;
        e := ERR_STARTMOVE;
        e := ERR_PROGSTOP;
        e := ERR_ALRDY_MOVING;
        e := ERR_ROBLIMIT;
        e := ERR_OUTSIDE_REACH;
        e := ERR_CONC_MAX;
        e := ERR_WHLSEARCH;
        e := ERR_SIGSUPSEARCH;
        e := ERR_PERSSUPSEARCH;
        e := ERR_SPEED_REFRESH_LIM;
        e := ERR_SPEEDLIM_VALUE;
        e := ERR_SYNCMOVEON;
        e := ERR_SYNCMOVEOFF;
        e := ERR_AXIS_ACT;
        e := ERR_AXIS_IND;
        e := ERR_AXIS_PAR;
        e := ERR_AXIS_MOVING;
        e := ERR_UNIT_PAR;
        e := ERR_UDPUC_COMM;
    ENDPROC
ENDMODULE
!=== errors_of_operator
! rule: names of errors: operator
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_TP_MAXTIME;
        e := ERR_TP_DIBREAK;
        e := ERR_TP_DOBREAK;
        e := ERR_TP_PERSBOOLBREAK;
        e := ERR_TP_NO_CLIENT;
        e := ERR_UI_INITVALUE;
        e := ERR_UI_MAXMIN;
        e := ERR_UI_NOTINT;
        e := ERR_UISHOW_FATAL;
        e := ERR_UISHOW_FULL;
    ENDPROC
ENDMODULE
!=== errors_of_signals
! rule: names of errors: signals
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_NORUNUNIT;
        e := ERR_NO_ALIASIO_DEF;
        e := ERR_ALIASIO_DEF;
        e := ERR_ALIASIO_TYPE;
        e := ERR_SIG_NOT_VALID;
        e := ERR_SIG_NAME;
        e := ERR_AO_LIM;
        e := ERR_GO_LIM;
        e := ERR_IOENABLE;
        e := ERR_IODISABLE;
        e := ERR_NAME_INVALID;
        e := ERR_BUSSTATE;
    ENDPROC
ENDMODULE
!=== errors_of_sockets
! rule: names of errors: sockets
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_SOCK_CLOSED;
        e := ERR_SOCK_TIMEOUT;
        e := ERR_SOCK_ADDR_INUSE;
        e := ERR_SOCK_ADDR_INVALID;
        e := ERR_SOCK_IS_BOUND;
        e := ERR_SOCK_NOT_BOUND;
        e := ERR_SOCK_IS_CONN;
        e := ERR_SOCK_NOT_CONN;
        e := ERR_SOCK_NET_UNREACH;
        e := ERR_SOCK_UNSPEC;
    ENDPROC
ENDMODULE
!=== errors_of_symbols
! rule: names of errors: symbols
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_TASKNAME;
        e := ERR_NO_TASK;
        e := ERR_NOT_MOVETASK;
        e := ERR_SYM_ACCESS;
        e := ERR_SYMBOL_TYPE;
        e := ERR_STANDNUM;
        e := ERR_CFG_NOTFND;
        e := ERR_CFG_ILLTYPE;
        e := ERR_CFG_LIMIT;
        e := ERR_CFG_INTERNAL;
    ENDPROC
ENDMODULE
!=== errors_of_values
! rule: names of errors: values
! source: [code] rapid-for-vim; [K §12]
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_DIVZERO;
        e := ERR_CALC_DIVZERO;
        e := ERR_CALC_NEG;
        e := ERR_CALC_OVERFLOW;
        e := ERR_OVERFLOW;
        e := ERR_NUM_LIMIT;
        e := ERR_INT_NOTVAL;
        e := ERR_INT_MAXVAL;
        e := ERR_MAXINTVAL;
        e := ERR_NOTINTVAL;
        e := ERR_NEGARG;
        e := ERR_ARGVALERR;
        e := ERR_STRTOOLNG;
        e := ERR_ILLQUAT;
        e := ERR_LIM_VALUE;
    ENDPROC
ENDMODULE
!=== errors_of_waits
! rule: names of errors: waits
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_WAIT_MAXTIME;
        e := ERR_WAIT_MAX;
        e := ERR_WAITSYNCTASK;
        e := ERR_DEV_MAXTIME;
        e := ERR_TIMEOUT;
    ENDPROC
ENDMODULE
!=== no_such_errors
! rule: names that look likely and do not exist
! source: [code] rapid-for-vim has the whole list
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_SOCK_NOT_CREATED;  ! -> RG302
        e := ERR_RAWBYTES;  ! -> RG302
    ENDPROC
ENDMODULE
