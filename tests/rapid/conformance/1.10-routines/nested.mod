! rule: routines do not nest
! source: [K §5]
MODULE Demo
    PROC a()
    PROC b()  ! -> RG202
    ENDPROC
ENDMODULE
