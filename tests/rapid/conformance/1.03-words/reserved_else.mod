! rule: ELSE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num else;  ! -> RG201
    ENDRECORD
ENDMODULE
