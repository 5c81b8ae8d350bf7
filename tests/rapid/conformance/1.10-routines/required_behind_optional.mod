! rule: a comma stands before a required parameter
! source: [K §5.1]
MODULE Demo
    PROC p(\num a num b)  ! -> RG201
    ENDPROC
ENDMODULE
