! rule: NOVIEW is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num noview;  ! -> RG201
    ENDRECORD
ENDMODULE
