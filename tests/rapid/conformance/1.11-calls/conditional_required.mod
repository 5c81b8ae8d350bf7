! rule: a required parameter is not handed on with ?
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num a)
        q \a?a;  ! -> RG316
    ENDPROC
    PROC q(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
