!=== break
! rule: arguments of Break
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Break;
        Break 1;  ! -> RG311
        Break \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== callbyvar
! rule: arguments of CallByVar
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        CallByVar "x", 1;
        CallByVar "x";  ! -> RG311
        CallByVar "x", 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== exitcycle
! rule: arguments of ExitCycle
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool a;
    PROC main()
        IF a ExitCycle;
        IF a ExitCycle 1;  ! -> RG311
    ENDPROC
ENDMODULE
!=== raisetouser
! rule: arguments of RaiseToUser
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RaiseToUser;
        RaiseToUser \Continue \ErrorNumber:=1;
        RaiseToUser \BreakOff \ErrorNumber:=1;
        RaiseToUser 1;  ! -> RG311
        RaiseToUser \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== release_unknown
! rule: what another release brings is a note where the release is unknown
! source: [code] a driver for RobotWare 5, 6 and 7 (UnpackRawBytes)
MODULE Demo
    PROC main()
        VAR rawbytes r;
        VAR string s;
        UnpackRawBytes r, 1, s \UTF8Encoding:=4;  ! -> RG325~
        UnpackRawBytes r, 1, s \ASCII:=4;
        TPWrite s;
        DebugBreak;  ! -> RG325~
    ENDPROC
ENDMODULE
!=== remainingretries
! rule: arguments of RemainingRetries
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := RemainingRetries();
        r_num := RemainingRetries(1);  ! -> RG311
        r_num := RemainingRetries(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== resetretrycount
! rule: arguments of ResetRetryCount
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ResetRetryCount;
        ResetRetryCount 1;  ! -> RG311
        ResetRetryCount \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stop
! rule: arguments of Stop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Stop;
        Stop \NoRegain;
        Stop \AllMoveTasks;
        Stop 1;  ! -> RG311
        Stop \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== systemstopaction
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
