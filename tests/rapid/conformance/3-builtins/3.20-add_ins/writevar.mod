! rule: arguments of WriteVar
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WriteVar "x", 1, 1;
        WriteVar "x", 1, 1 \TaskName:="x";
        WriteVar;  ! -> RG311?
        WriteVar "x", 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
