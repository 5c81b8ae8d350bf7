! rule: arguments of SafetyControllerGetChecksum
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetChecksum();
        result := SafetyControllerGetChecksum(1);  ! -> RG311?
    ENDPROC
ENDMODULE
