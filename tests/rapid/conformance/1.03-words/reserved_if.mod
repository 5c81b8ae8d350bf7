! rule: IF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num if;  ! -> RG201
    ENDRECORD
ENDMODULE
