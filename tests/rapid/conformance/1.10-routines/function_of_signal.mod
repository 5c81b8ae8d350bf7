! rule: a FUNC returns no semivalue type
! source: [K §2.16]
MODULE Demo
    FUNC signaldi f()  ! -> RG309
        EXIT;
    ENDFUNC
ENDMODULE
