! rule: arguments of InitSuperv
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        InitSuperv;
        InitSuperv 1;  ! -> RG311?
    ENDPROC
ENDMODULE
