! rule: alternatives share one backslash, one may be given
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \a:=1;
        p \b:="x";
        p \c;
        p;
        p \a:=1 \c;  ! -> RG313
    ENDPROC
    PROC p(\num a | string b | switch c)
        IF Present(a) OR Present(b) OR Present(c) TPErase;
    ENDPROC
ENDMODULE
