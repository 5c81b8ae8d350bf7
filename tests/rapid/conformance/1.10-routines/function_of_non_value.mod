! rule: a FUNC returns a value type
! source: [K §5.4]
MODULE Demo
    PROC main()
    ENDPROC
    FUNC clock f()  ! -> RG309
        RETURN 1;
    ENDFUNC
ENDMODULE
