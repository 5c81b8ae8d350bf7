! rule: a size is whole
! source: [K §2.22]
MODULE Demo
    VAR num a{1.5};  ! -> RG318
ENDMODULE
