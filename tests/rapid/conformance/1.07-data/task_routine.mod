! rule: there is no TASK routine
! source: [K §5.3]
MODULE Demo
    TASK PROC a()  ! -> RG201
    ENDPROC
ENDMODULE
