! rule: a lone backslash is an error
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "a\z";  ! -> RG206
    ENDPROC
ENDMODULE
