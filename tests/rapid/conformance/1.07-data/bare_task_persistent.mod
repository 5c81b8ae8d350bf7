! rule: a TASK PERS has an initial value
! source: [K §2.23]
MODULE Demo
    TASK PERS num a;  ! -> RG317
ENDMODULE
