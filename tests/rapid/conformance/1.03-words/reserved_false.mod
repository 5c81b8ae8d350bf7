! rule: FALSE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num false;  ! -> RG201
    ENDRECORD
ENDMODULE
