! rule: STEP is reserved
! source: [K §2.4]
MODULE Demo
    RECORD r
        num step;  ! -> RG201
    ENDRECORD
ENDMODULE
