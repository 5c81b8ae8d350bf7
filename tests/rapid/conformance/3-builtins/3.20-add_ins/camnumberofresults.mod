! rule: arguments of CamNumberOfResults
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR num r;
    PROC main()
        r := CamNumberOfResults(v_cameradev);
        r := CamNumberOfResults(v_cameradev \SceneId:=1);
        r := CamNumberOfResults();  ! -> RG311
        r := CamNumberOfResults(v_cameradev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
