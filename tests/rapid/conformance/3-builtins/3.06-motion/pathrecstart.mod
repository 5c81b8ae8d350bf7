! rule: arguments of PathRecStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecStart v_pathrecid;
        PathRecStart;  ! -> RG311?
        PathRecStart v_pathrecid \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
