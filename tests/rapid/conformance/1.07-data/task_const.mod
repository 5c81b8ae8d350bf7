! rule: there is no TASK CONST
! source: [K §2.18]
MODULE Demo
    TASK CONST num a := 1;  ! -> RG201
ENDMODULE
