! rule: PROC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num proc;  ! -> RG201
    ENDRECORD
ENDMODULE
