! rule: arguments of IEnable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IEnable;
        IEnable 1;  ! -> RG311
        IEnable \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
