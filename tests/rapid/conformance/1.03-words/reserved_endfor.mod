! rule: ENDFOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endfor;  ! -> RG201
    ENDRECORD
ENDMODULE
