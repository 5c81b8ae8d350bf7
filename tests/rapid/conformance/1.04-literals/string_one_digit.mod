! rule: one hexadecimal digit is not enough
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "\0";  ! -> RG206
    ENDPROC
ENDMODULE
