! rule: arguments of StopMoveReset
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StopMoveReset;
        StopMoveReset \AllMotionTasks;
        StopMoveReset 1;  ! -> RG311
        StopMoveReset \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
