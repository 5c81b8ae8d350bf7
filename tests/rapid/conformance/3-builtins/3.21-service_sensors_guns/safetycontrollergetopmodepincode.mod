! rule: arguments of SafetyControllerGetOpModePinCode
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetOpModePinCode();
        result := SafetyControllerGetOpModePinCode(1);  ! -> RG311?
    ENDPROC
ENDMODULE
