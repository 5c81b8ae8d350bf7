! rule: an index lies within the size
! source: [K §3.5]; loaded: Utility.sys in backups of two IRB 120 (RobotWare 5.15)
MODULE Demo
    CONST num n := 3;
    VAR num a{n};
    PROC main()
        a{n + 1} := 1;  ! -> RG318?
    ENDPROC
ENDMODULE
