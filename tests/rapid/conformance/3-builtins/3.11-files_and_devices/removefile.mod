! rule: arguments of RemoveFile
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveFile "x";
        RemoveFile;  ! -> RG311?
        RemoveFile "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
