! rule: FOR is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num for;  ! -> RG201
    ENDRECORD
ENDMODULE
