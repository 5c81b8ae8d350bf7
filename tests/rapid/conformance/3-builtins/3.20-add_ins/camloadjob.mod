! rule: arguments of CamLoadJob
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamLoadJob v_cameradev, "x";
        CamLoadJob v_cameradev, "x" \KeepTargets \MaxTime:=1;
        CamLoadJob;  ! -> RG311?
        CamLoadJob v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
