! rule: arguments of SafetyControllerSyncRequest
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SafetyControllerSyncRequest;
        SafetyControllerSyncRequest 1;  ! -> RG311?
    ENDPROC
ENDMODULE
