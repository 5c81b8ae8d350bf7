! rule: arguments of PoseInv
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pose r_pose;
    PROC main()
        r_pose := PoseInv(v_pose);
        r_pose := PoseInv();  ! -> RG311
        r_pose := PoseInv(v_pose \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
