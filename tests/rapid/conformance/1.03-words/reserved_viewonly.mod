! rule: VIEWONLY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num viewonly;  ! -> RG201
    ENDRECORD
ENDMODULE
