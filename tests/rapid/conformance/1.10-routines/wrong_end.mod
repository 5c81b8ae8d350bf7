! rule: a routine ends with its own word
! source: [K §5.3, 5.4]
MODULE Demo
    PROC p()
    ENDFUNC  ! -> RG201
ENDMODULE
