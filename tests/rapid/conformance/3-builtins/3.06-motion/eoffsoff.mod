! rule: arguments of EOffsOff
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        EOffsOff;
        EOffsOff 1;  ! -> RG311
        EOffsOff \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
