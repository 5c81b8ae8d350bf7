! rule: a tab in a string is written as a code
! source: [K §2.1, 2.7]
MODULE Demo
    PROC main()
        TPWrite "a	b";  ! -> RG206?
    ENDPROC
ENDMODULE
