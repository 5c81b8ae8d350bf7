! rule: a switch takes no value
! source: [K §5.1]
MODULE Demo
    PROC main()
        p \s:=TRUE;  ! -> RG312
    ENDPROC
    PROC p(\switch s)
        IF Present(s) TPErase;
    ENDPROC
ENDMODULE
