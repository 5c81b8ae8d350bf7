! rule: arguments of ReadDir
! source: [manual] 3HAC050917
MODULE Demo
    VAR dir v_dir;
    VAR string v_string;
    VAR bool r_bool;
    PROC main()
        r_bool := ReadDir(v_dir, v_string);
        r_bool := ReadDir(v_dir);  ! -> RG311
        r_bool := ReadDir(v_dir, v_string \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
