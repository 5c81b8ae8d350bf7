! rule: arguments of RenameFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RenameFile "x", "x";
        RenameFile "x";  ! -> RG311
        RenameFile "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
