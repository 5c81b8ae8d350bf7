! rule: arguments of CamGetParameter
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR cameradev v_cameradev;
    VAR num v_num;
    PROC main()
        CamGetParameter v_cameradev, "x";
        CamGetParameter v_cameradev, "x" \NumVar:=v_num;
        CamGetParameter v_cameradev, "x" \BoolVar:=v_bool;
        CamGetParameter;  ! -> RG311?
        CamGetParameter v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
