! rule: ELSEIF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num elseif;  ! -> RG201
    ENDRECORD
ENDMODULE
