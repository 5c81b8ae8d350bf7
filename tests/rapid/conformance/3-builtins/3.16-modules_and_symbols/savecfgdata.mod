! rule: arguments of SaveCfgData
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SaveCfgData "x", "SYS";
        SaveCfgData "x" \File:="x", "SYS";
        SaveCfgData "x";  ! -> RG311
        SaveCfgData "x", "SYS" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
