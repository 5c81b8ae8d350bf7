! rule: a PERS is of a value type
! source: [K §2.23]
MODULE Demo
    PERS rawbytes a;  ! -> RG309
ENDMODULE
