! rule: a TRAP has no parameters
! source: [K §5.5]
MODULE Demo
    TRAP t()  ! -> RG201
    ENDTRAP
ENDMODULE
