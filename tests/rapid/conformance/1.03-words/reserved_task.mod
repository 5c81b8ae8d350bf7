! rule: TASK is reserved
! source: [K §2.18]
MODULE Demo
    RECORD r
        num task;  ! -> RG201
    ENDRECORD
ENDMODULE
