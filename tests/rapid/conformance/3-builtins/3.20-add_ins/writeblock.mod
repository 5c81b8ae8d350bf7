! rule: arguments of WriteBlock
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WriteBlock "x", 1, "x";
        WriteBlock "x", 1, "x" \TaskName:="x";
        WriteBlock;  ! -> RG311?
        WriteBlock "x", 1, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
