! rule: WHILE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num while;  ! -> RG201
    ENDRECORD
ENDMODULE
