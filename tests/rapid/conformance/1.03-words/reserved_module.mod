! rule: MODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num module;  ! -> RG201
    ENDRECORD
ENDMODULE
