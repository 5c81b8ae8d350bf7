! rule: ENDPROC is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endproc;  ! -> RG201
    ENDRECORD
ENDMODULE
