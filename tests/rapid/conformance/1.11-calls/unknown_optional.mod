! rule: an optional argument has its parameter
! source: [K §3.10]
MODULE Demo
    PROC main()
        p \b:=1;  ! -> RG312
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
