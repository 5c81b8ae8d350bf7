! rule: arguments of PoseVect
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pos r_pos;
    PROC main()
        r_pos := PoseVect(v_pose, [1, 2, 3]);
        r_pos := PoseVect(v_pose);  ! -> RG311
        r_pos := PoseVect(v_pose, [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
