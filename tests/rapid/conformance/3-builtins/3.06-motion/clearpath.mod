! rule: arguments of ClearPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ClearPath;
        ClearPath 1;  ! -> RG311
        ClearPath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
