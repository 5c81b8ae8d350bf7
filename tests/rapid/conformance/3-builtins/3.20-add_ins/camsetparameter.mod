! rule: arguments of CamSetParameter
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetParameter v_cameradev, "x";
        CamSetParameter v_cameradev, "x" \NumVal:=1;
        CamSetParameter v_cameradev, "x" \BoolVal:=TRUE;
        CamSetParameter;  ! -> RG311?
        CamSetParameter v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
