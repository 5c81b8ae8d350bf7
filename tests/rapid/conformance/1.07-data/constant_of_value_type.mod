! rule: a CONST is of a value type
! source: [K §2.24]
MODULE Demo
    CONST socketdev a := 0;  ! -> RG309
ENDMODULE
