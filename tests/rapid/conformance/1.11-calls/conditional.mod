! rule: an optional parameter is handed on with ?
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a \switch s)
        q \a?a \s?s;
    ENDPROC
    PROC q(\num a \switch s)
        IF Present(a) OR Present(s) TPErase;
    ENDPROC
ENDMODULE
