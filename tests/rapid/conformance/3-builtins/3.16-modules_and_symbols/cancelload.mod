! rule: arguments of CancelLoad
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadsession v_loadsession;
    PROC main()
        CancelLoad v_loadsession;
        CancelLoad;  ! -> RG311?
        CancelLoad v_loadsession \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
