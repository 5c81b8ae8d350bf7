! rule: DIV is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num div;  ! -> RG201
    ENDRECORD
ENDMODULE
