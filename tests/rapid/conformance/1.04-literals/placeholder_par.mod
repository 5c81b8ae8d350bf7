! rule: <PAR> stands for a parameter
! source: [K §2.9, 5.1]
MODULE Demo
    PROC p(<PAR>)
    ENDPROC
ENDMODULE
