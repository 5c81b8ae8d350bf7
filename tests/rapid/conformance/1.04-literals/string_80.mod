! rule: a string has up to 80 characters
! source: [K §2.13]
MODULE Demo
    PROC main()
        TPWrite "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";
    ENDPROC
ENDMODULE
