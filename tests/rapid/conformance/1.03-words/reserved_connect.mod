! rule: CONNECT is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num connect;  ! -> RG201
    ENDRECORD
ENDMODULE
