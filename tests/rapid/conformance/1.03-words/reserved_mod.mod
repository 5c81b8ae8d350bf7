! rule: MOD is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num mod;  ! -> RG201
    ENDRECORD
ENDMODULE
