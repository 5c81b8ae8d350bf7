! rule: arguments of SyncMoveResume
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SyncMoveResume;
        SyncMoveResume 1;  ! -> RG311
        SyncMoveResume \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
