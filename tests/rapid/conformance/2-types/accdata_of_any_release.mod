! rule: values that older releases saved lack components
! source: [backup] RobotWare 6.13 has finepramp in accdata, earlier ones have not
MODULE Demo
    PERS accdata older := [100, 100];
    PERS accdata newer := [100, 100, 50];
    PERS accdata short := [100];  ! -> RG330
    PROC main()
        newer.finepramp := older.acc;
    ENDPROC
ENDMODULE
