! rule: ENDRECORD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endrecord;  ! -> RG201
    ENDRECORD
ENDMODULE
