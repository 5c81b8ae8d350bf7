! rule: a call of a FUNC is no statement
! source: [K §4]
MODULE Demo
    PROC main()
        f;  ! -> RG306
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
