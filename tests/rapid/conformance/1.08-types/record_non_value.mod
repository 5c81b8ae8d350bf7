! rule: a non-value component makes the record non-value
! source: [K §2.16] [code] abb_driver
MODULE Demo
    RECORD message
        num id;
        rawbytes data;
    ENDRECORD
    VAR message a;
    PERS message b;  ! -> RG309
    PROC main()
        ClearRawBytes a.data;
    ENDPROC
ENDMODULE
