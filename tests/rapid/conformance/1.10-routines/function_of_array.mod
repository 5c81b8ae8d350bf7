! rule: a FUNC returns no array
! source: [K §5.4]
MODULE Demo
    FUNC num{3} f()  ! -> RG201
        RETURN 1;
    ENDFUNC
ENDMODULE
