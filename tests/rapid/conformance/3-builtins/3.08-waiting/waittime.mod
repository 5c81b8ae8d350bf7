! rule: arguments of WaitTime
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WaitTime 1;
        WaitTime \InPos, 1;
        WaitTime;  ! -> RG311?
        WaitTime 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
