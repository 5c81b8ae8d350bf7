! rule: arguments of PathRecMoveFwd
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecMoveFwd;
        PathRecMoveFwd \ID:=v_pathrecid \ToolOffs:=[1, 2, 3] \Speed:=v100;
        PathRecMoveFwd 1;  ! -> RG311
        PathRecMoveFwd \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
