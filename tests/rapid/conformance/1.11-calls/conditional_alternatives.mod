! rule: several conditional arguments may serve alternatives
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \a:=1;
    ENDPROC
    PROC p(\num a \string b)
        q \a?a \b?b;
    ENDPROC
    PROC q(\num a | string b)
        IF Present(a) OR Present(b) TPErase;
    ENDPROC
ENDMODULE
