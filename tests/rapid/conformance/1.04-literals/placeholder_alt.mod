! rule: <ALT> stands for an alternative parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(\num a | <ALT>)
    ENDPROC
ENDMODULE
