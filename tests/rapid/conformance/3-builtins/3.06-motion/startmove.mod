! rule: arguments of StartMove
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StartMove;
        StartMove \AllMotionTasks;
        StartMove 1;  ! -> RG311
        StartMove \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
