! rule: TO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num to;  ! -> RG201
    ENDRECORD
ENDMODULE
