! rule: arguments of CamGetName
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR string r;
    PROC main()
        r := CamGetName(v_cameradev);
        r := CamGetName();  ! -> RG311
        r := CamGetName(v_cameradev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
