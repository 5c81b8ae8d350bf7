! rule: a module that is not here may hide a built-in that not every controller has
! source: [K §2.12] [code] TechnoX/ABB-YUMI-LIB calls its own GetJointData from another module
MODULE Demo
    VAR num n;
    PROC main()
        GetJointData 1, 2, n, n;  ! -> RG311?
        Incr n, 2;  ! -> RG311
        Reset;  ! -> RG311?
    ENDPROC
ENDMODULE
