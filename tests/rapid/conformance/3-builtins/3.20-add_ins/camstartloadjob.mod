! rule: arguments of CamStartLoadJob
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamStartLoadJob v_cameradev, "x";
        CamStartLoadJob v_cameradev, "x" \KeepTargets;
        CamStartLoadJob;  ! -> RG311?
        CamStartLoadJob v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
