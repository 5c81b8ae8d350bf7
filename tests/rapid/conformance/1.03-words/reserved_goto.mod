! rule: GOTO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num goto;  ! -> RG201
    ENDRECORD
ENDMODULE
