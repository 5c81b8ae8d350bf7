! rule: arguments of RestoPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RestoPath;
        RestoPath 1;  ! -> RG311
        RestoPath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
