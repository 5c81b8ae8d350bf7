! rule: CONST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num const;  ! -> RG201
    ENDRECORD
ENDMODULE
