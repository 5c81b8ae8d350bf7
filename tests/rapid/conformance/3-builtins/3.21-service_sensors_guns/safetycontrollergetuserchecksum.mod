! rule: arguments of SafetyControllerGetUserChecksum
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetUserChecksum();
        result := SafetyControllerGetUserChecksum(1);  ! -> RG311?
    ENDPROC
ENDMODULE
