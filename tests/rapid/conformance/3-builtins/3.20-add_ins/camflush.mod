! rule: arguments of CamFlush
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamFlush v_cameradev;
        CamFlush;  ! -> RG311?
        CamFlush v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
