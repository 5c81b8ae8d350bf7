! rule: a switch is an optional parameter
! source: [K §5.1]
MODULE Demo
    PROC p(switch a)  ! -> RG328
    ENDPROC
ENDMODULE
