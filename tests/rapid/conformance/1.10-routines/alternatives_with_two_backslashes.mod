! rule: alternatives have one backslash
! source: [K §5.1]
MODULE Demo
    PROC p(\num a | \num b)  ! -> RG201
    ENDPROC
ENDMODULE
