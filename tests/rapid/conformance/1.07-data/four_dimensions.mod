! rule: no fourth dimension
! source: [K §2.22]
MODULE Demo
    VAR num a{1, 2, 3, 4};  ! -> RG318
ENDMODULE
