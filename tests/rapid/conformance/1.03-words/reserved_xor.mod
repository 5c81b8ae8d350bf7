! rule: XOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num xor;  ! -> RG201
    ENDRECORD
ENDMODULE
