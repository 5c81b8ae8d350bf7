! rule: arguments of PDispSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    PROC main()
        PDispSet v_pose;
        PDispSet;  ! -> RG311?
        PDispSet v_pose \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
