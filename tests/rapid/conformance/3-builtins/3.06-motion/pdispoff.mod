! rule: arguments of PDispOff
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PDispOff;
        PDispOff 1;  ! -> RG311
        PDispOff \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
