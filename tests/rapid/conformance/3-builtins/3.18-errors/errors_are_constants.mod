! rule: names of errors are constants of type errnum
! source: [K §12]
! given: system
MODULE Demo
    VAR string s;
    PROC main()
        ERR_DIVZERO := 1;  ! -> RG310
        s := ERR_DIVZERO;  ! -> RG307
    ENDPROC
ENDMODULE
