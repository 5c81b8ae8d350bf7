! rule: EXIT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num exit;  ! -> RG201
    ENDRECORD
ENDMODULE
