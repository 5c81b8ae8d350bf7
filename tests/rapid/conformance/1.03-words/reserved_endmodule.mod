! rule: ENDMODULE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endmodule;  ! -> RG201
    ENDRECORD
ENDMODULE
