! rule: CASE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num case;  ! -> RG201
    ENDRECORD
ENDMODULE
