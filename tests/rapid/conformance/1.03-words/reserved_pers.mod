! rule: PERS is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num pers;  ! -> RG201
    ENDRECORD
ENDMODULE
