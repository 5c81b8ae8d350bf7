! rule: RAISE stands in an ERROR handler only
! source: [K §4.8, 4.10, 4.11]
MODULE Demo
    PROC main()
        RAISE;  ! -> RG321
    ENDPROC
ENDMODULE
