! rule: arguments of GripLoad
! source: [manual] 3HAC050917
MODULE Demo
    PERS loaddata p_loaddata;
    PROC main()
        GripLoad p_loaddata;
        GripLoad;  ! -> RG311?
        GripLoad p_loaddata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
