! rule: a TRAP has no BACKWARD handler
! source: [K §5.5]
MODULE Demo
    TRAP t
    BACKWARD  ! -> RG216
    ENDTRAP
ENDMODULE
