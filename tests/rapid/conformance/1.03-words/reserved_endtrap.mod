! rule: ENDTRAP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endtrap;  ! -> RG201
    ENDRECORD
ENDMODULE
