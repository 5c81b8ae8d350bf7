! rule: RAISE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num raise;  ! -> RG201
    ENDRECORD
ENDMODULE
