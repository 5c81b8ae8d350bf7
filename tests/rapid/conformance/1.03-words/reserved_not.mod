! rule: NOT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num not;  ! -> RG201
    ENDRECORD
ENDMODULE
