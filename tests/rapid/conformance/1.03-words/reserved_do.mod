! rule: DO is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num do;  ! -> RG201
    ENDRECORD
ENDMODULE
