! rule: a record does not contain itself
! source: [K §2.14]
MODULE Demo
    RECORD r
        r x;  ! -> RG327
    ENDRECORD
ENDMODULE
