! rule: TEST is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num test;  ! -> RG201
    ENDRECORD
ENDMODULE
