! rule: INOUT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num inout;  ! -> RG201
    ENDRECORD
ENDMODULE
