! rule: VAR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num var;  ! -> RG201
    ENDRECORD
ENDMODULE
