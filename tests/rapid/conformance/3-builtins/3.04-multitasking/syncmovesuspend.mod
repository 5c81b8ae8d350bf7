! rule: arguments of SyncMoveSuspend
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SyncMoveSuspend;
        SyncMoveSuspend 1;  ! -> RG311
        SyncMoveSuspend \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
