! rule: OR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num or;  ! -> RG201
    ENDRECORD
ENDMODULE
