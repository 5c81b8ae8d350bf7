! rule: arguments of StepBwdPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StepBwdPath 1, 1;
        StepBwdPath 1;  ! -> RG311
        StepBwdPath 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
