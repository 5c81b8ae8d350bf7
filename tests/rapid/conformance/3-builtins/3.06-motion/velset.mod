! rule: arguments of VelSet
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        VelSet 1, 1;
        VelSet 1;  ! -> RG311
        VelSet 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
