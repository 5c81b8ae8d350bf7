! rule: arguments of CamSetExposure
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetExposure v_cameradev;
        CamSetExposure v_cameradev \ExposureTime:=1 \Brightness:=1 \Contrast:=1;
        CamSetExposure;  ! -> RG311?
        CamSetExposure v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
