! rule: an optional parameter is handed on to its type
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a)
        q \a?a;  ! -> RG307
    ENDPROC
    PROC q(\string a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
