! rule: ENDTEST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endtest;  ! -> RG201
    ENDRECORD
ENDMODULE
