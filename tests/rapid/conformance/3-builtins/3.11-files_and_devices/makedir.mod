! rule: arguments of MakeDir
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MakeDir "x";
        MakeDir;  ! -> RG311?
        MakeDir "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
