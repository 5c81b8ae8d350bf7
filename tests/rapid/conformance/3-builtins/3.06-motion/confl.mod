! rule: arguments of ConfL
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ConfL;
        ConfL \On;
        ConfL \Off;
        ConfL 1;  ! -> RG311
        ConfL \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
