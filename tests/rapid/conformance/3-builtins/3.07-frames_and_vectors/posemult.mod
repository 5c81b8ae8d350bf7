! rule: arguments of PoseMult
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pose r_pose;
    PROC main()
        r_pose := PoseMult(v_pose, v_pose);
        r_pose := PoseMult(v_pose);  ! -> RG311
        r_pose := PoseMult(v_pose, v_pose \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
