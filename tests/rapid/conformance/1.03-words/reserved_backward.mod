! rule: BACKWARD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num backward;  ! -> RG201
    ENDRECORD
ENDMODULE
