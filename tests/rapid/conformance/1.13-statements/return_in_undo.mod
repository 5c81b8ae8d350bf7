! rule: no RETURN in an UNDO handler
! source: [K §4.7]
MODULE Demo
    PROC main()
    UNDO
        RETURN;  ! -> RG321
    ENDPROC
ENDMODULE
