! rule: arguments of RemoveDir
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveDir "x";
        RemoveDir;  ! -> RG311?
        RemoveDir "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
