! rule: arguments of PathRecMoveBwd
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecMoveBwd;
        PathRecMoveBwd \ID:=v_pathrecid \ToolOffs:=[1, 2, 3] \Speed:=v100;
        PathRecMoveBwd 1;  ! -> RG311
        PathRecMoveBwd \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
