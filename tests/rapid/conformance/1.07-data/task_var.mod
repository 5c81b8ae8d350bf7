! rule: TASK VAR and TASK PERS
! source: [K §2.18]
MODULE Demo
    TASK VAR num a;
    TASK PERS num b := 1;
ENDMODULE
