! rule: ALIAS is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num alias;  ! -> RG201
    ENDRECORD
ENDMODULE
