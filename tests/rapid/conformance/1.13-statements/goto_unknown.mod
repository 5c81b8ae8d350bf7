! rule: a GOTO has its label in the routine
! source: [K §4.3]
MODULE Demo
    PROC main()
        GOTO nowhere;  ! -> RG320
    ENDPROC
ENDMODULE
