! rule: TRYNEXT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num trynext;  ! -> RG201
    ENDRECORD
ENDMODULE
