! rule: arguments of CopyFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CopyFile "x", "x";
        CopyFile "x";  ! -> RG311
        CopyFile "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
