! rule: arguments of StartLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        StartLoad "x", v_loadsession;
        StartLoad \Dynamic, "x" \File:="x", v_loadsession;
        StartLoad "x";  ! -> RG311
        StartLoad "x", v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
