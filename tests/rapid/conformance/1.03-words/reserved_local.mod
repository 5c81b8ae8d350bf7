! rule: LOCAL is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num local;  ! -> RG201
    ENDRECORD
ENDMODULE
