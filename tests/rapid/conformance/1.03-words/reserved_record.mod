! rule: RECORD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num record;  ! -> RG201
    ENDRECORD
ENDMODULE
