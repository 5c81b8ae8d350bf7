! rule: a backslash and two hexadecimal digits are a byte
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "\0D\0a";
    ENDPROC
ENDMODULE
