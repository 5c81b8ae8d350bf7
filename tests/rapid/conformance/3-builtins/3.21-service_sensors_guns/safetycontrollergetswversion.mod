! rule: arguments of SafetyControllerGetSWVersion
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetSWVersion();
        result := SafetyControllerGetSWVersion(1);  ! -> RG311?
    ENDPROC
ENDMODULE
