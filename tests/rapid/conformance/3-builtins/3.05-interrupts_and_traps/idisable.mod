! rule: arguments of IDisable
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        IDisable;
        IDisable 1;  ! -> RG311
        IDisable \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
