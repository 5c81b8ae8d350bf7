! rule: arguments of CamSetRunMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetRunMode v_cameradev;
        CamSetRunMode;  ! -> RG311?
        CamSetRunMode v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
