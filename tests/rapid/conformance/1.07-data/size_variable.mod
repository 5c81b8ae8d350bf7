! rule: a size is a constant expression
! source: [K §2.22]
MODULE Demo
    VAR num n := 2;
    VAR num a{n};  ! -> RG317
ENDMODULE
