! rule: arguments of OpenDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    PROC main()
        OpenDir v_dir, "x";
        OpenDir v_dir;  ! -> RG311
        OpenDir v_dir, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
