! rule: arguments of CamReqImage
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR num v_num;
    PROC main()
        CamReqImage v_cameradev;
        CamReqImage v_cameradev \SceneId:=v_num \KeepTargets \AwaitComplete;
        CamReqImage;  ! -> RG311?
        CamReqImage v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
