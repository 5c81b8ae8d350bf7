! rule: arguments of StopMove
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StopMove;
        StopMove \Quick \AllMotionTasks;
        StopMove 1;  ! -> RG311
        StopMove \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
