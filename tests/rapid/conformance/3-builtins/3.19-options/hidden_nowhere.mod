! rule: nothing hides a built-in where everything is here
! source: [K §2.12]
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        GetJointData 1, 2, n, n;  ! -> RG311
        Incr n, 2;  ! -> RG311
        Reset;  ! -> RG311
    ENDPROC
ENDMODULE
