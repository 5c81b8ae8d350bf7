! rule: arguments of CamSetProgramMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetProgramMode v_cameradev;
        CamSetProgramMode;  ! -> RG311?
        CamSetProgramMode v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
