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
