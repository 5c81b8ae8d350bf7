! rule: ERROR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num error;  ! -> RG201
    ENDRECORD
ENDMODULE
