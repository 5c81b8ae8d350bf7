! rule: an optional argument is named
! source: [K §3.10]
MODULE Demo
    PROC main()
        p 1;  ! -> RG311
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
