! rule: a quote in a string is written twice
! source: [K §2.7]
MODULE Demo
    PROC main()
        TPWrite "a ""b"" c";
    ENDPROC
ENDMODULE
