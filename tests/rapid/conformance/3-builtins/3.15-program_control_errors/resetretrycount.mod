! rule: arguments of ResetRetryCount
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ResetRetryCount;
        ResetRetryCount 1;  ! -> RG311
        ResetRetryCount \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
