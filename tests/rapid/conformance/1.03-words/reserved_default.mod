! rule: DEFAULT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num default;  ! -> RG201
    ENDRECORD
ENDMODULE
