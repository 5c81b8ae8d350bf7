! rule: LOCAL and TASK exclude each other
! source: [K §2.18]
MODULE Demo
    LOCAL TASK VAR num a;  ! -> RG201
ENDMODULE
