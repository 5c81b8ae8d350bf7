! rule: a PROC returns no value
! source: [K §4.7]
MODULE Demo
    PROC main()
        RETURN 1;  ! -> RG321
    ENDPROC
ENDMODULE
