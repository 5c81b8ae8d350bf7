! rule: arguments of WarmStart
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WarmStart;
        WarmStart 1;  ! -> RG311
        WarmStart \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
