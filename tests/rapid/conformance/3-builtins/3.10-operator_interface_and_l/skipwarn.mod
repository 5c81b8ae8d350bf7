! rule: arguments of SkipWarn
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SkipWarn;
        SkipWarn 1;  ! -> RG311
        SkipWarn \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
