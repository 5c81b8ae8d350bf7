! rule: errnum is an alias too
! source: [K §2.15]
MODULE Demo
    ALIAS errnum a;  ! -> RG327
ENDMODULE
