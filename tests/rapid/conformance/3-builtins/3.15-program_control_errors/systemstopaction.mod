! rule: arguments of SystemStopAction
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SystemStopAction;
        SystemStopAction \Stop;
        SystemStopAction \StopBlock;
        SystemStopAction \Halt;
        SystemStopAction 1;  ! -> RG311
        SystemStopAction \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
