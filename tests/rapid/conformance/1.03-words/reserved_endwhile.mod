! rule: ENDWHILE is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num endwhile;  ! -> RG201
    ENDRECORD
ENDMODULE
