! rule: RETRY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num retry;  ! -> RG201
    ENDRECORD
ENDMODULE
