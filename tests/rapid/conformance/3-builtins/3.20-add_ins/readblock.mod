! rule: arguments of ReadBlock
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ReadBlock "x", 1, "x";
        ReadBlock "x", 1, "x" \TaskName:="x";
        ReadBlock;  ! -> RG311?
        ReadBlock "x", 1, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
