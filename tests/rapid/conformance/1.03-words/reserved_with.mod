! rule: WITH is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num with;  ! -> RG201
    ENDRECORD
ENDMODULE
