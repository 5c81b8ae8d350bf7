! rule: <DIM> stands for the dimensions of a parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(num a{<DIM>})
    ENDPROC
ENDMODULE
