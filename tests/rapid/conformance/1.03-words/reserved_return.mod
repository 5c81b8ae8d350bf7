! rule: RETURN is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num return;  ! -> RG201
    ENDRECORD
ENDMODULE
