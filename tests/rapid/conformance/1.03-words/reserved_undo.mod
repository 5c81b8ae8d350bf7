! rule: UNDO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num undo;  ! -> RG201
    ENDRECORD
ENDMODULE
