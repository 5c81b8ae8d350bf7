! rule: a CONST has a value
! source: [K §2.24]
MODULE Demo
    CONST num a;  ! -> RG201
ENDMODULE
