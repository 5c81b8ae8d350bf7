MODULE dialogs
    ! source: [manual] S4 TPReadNum, TPReadFK; ERR_TP_NO_CLIENT when nobody is there (3HAC16581-1)
    ! expect: how many?
    ! expect: nobody
    ! expect: FALSE
    PROC main()
        VAR num answer;
        VAR errnum broken;
        TPWrite "how many?";
        TPReadNum answer, "?";
        TPReadFK answer, "?", "a", "", "", "", "" \BreakFlag:=broken;
        IF broken <> ERR_TP_NO_CLIENT TPWrite "wrong";
        TPWrite ValToStr(UIClientExist());
    ERROR
        IF ERRNO = ERR_TP_NO_CLIENT TPWrite "nobody";
        TRYNEXT;
    ENDPROC
ENDMODULE
