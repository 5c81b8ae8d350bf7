! rule: arguments of WaitLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        WaitLoad v_loadsession;
        WaitLoad \UnloadPath:="x" \UnloadFile:="x", v_loadsession \CheckRef;
        WaitLoad;  ! -> RG311?
        WaitLoad v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
