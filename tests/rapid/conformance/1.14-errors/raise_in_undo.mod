! rule: no RAISE, RETRY or TRYNEXT in an UNDO handler
! source: [K §4.8]
MODULE Demo
    PROC main()
    UNDO
        RAISE;  ! -> RG321
    ENDPROC
ENDMODULE
