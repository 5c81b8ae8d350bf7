! rule: FROM is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num from;  ! -> RG201
    ENDRECORD
ENDMODULE
