! rule: FUNC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num func;  ! -> RG201
    ENDRECORD
ENDMODULE
