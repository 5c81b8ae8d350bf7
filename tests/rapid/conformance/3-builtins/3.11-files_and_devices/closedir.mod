! rule: arguments of CloseDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    PROC main()
        CloseDir v_dir;
        CloseDir;  ! -> RG311?
        CloseDir v_dir \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
