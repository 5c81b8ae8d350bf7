! rule: a LOCAL PERS has an initial value
! source: [K §2.23]
MODULE Demo
    LOCAL PERS num a;  ! -> RG317
ENDMODULE
