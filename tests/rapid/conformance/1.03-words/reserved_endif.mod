! rule: ENDIF is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endif;  ! -> RG201
    ENDRECORD
ENDMODULE
