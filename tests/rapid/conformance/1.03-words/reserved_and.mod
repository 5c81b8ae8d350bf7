! rule: AND is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num and;  ! -> RG201
    ENDRECORD
ENDMODULE
