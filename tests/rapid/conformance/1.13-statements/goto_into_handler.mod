! rule: a GOTO may not enter a handler
! source: [K §4.6]
MODULE Demo
    PROC main()
        GOTO inside;  ! -> RG320
    ERROR
        inside:
        TRYNEXT;
    ENDPROC
ENDMODULE
