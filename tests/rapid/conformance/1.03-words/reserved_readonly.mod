! rule: READONLY is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num readonly;  ! -> RG201
    ENDRECORD
ENDMODULE
