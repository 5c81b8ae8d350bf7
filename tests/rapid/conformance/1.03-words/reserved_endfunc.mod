! rule: ENDFUNC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endfunc;  ! -> RG201
    ENDRECORD
ENDMODULE
