! rule: a FUNC has no BACKWARD handler
! source: [K §5.4]
MODULE Demo
    FUNC num f()
        RETURN 1;
    BACKWARD  ! -> RG216
    ENDFUNC
ENDMODULE
