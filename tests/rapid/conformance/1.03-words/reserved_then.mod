! rule: THEN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num then;  ! -> RG201
    ENDRECORD
ENDMODULE
