! rule: NOSTEPIN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num nostepin;  ! -> RG201
    ENDRECORD
ENDMODULE
