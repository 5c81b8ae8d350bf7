! rule: arguments of ExecLevel
! source: [manual] 3HAC050917
MODULE Demo
    VAR exec_level r_exec_level;
    PROC main()
        r_exec_level := ExecLevel();
        r_exec_level := ExecLevel(1);  ! -> RG311
        r_exec_level := ExecLevel(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
