! rule: TRUE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num true;  ! -> RG201
    ENDRECORD
ENDMODULE
