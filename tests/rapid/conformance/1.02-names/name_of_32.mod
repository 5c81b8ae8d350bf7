! rule: a name has up to 32 characters
! source: [K §2.3]
MODULE Demo
    VAR num nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn;
    PROC main()
        nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn := 1;
    ENDPROC
ENDMODULE
