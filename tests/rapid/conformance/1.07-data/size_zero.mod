! rule: a size is at least 1
! source: [K §2.22]
MODULE Demo
    VAR num a{0};  ! -> RG318
ENDMODULE
