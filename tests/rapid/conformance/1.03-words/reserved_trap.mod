! rule: TRAP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num trap;  ! -> RG201
    ENDRECORD
ENDMODULE
