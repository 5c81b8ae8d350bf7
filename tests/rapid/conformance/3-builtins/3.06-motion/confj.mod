! rule: arguments of ConfJ
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ConfJ;
        ConfJ \On;
        ConfJ \Off;
        ConfJ 1;  ! -> RG311
        ConfJ \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
