! rule: an optional argument that is no switch has a value
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \a;  ! -> RG312
    ENDPROC
    PROC p(\num a)
        IF Present(a) TPErase;
    ENDPROC
ENDMODULE
