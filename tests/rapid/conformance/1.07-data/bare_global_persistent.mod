! rule: a global PERS may lack an initial value
! source: [K §2.23]
MODULE Demo
    PERS tooldata t;
ENDMODULE
