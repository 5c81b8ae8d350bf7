! rule: a module may declare a predefined name
! source: [K §2.12]
MODULE Demo
    PROC main()
        StrLen;
    ENDPROC
    PROC StrLen()
    ENDPROC
ENDMODULE
