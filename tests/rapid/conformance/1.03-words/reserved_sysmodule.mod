! rule: SYSMODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num sysmodule;  ! -> RG201
    ENDRECORD
ENDMODULE
