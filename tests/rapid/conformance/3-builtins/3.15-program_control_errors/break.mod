! rule: arguments of Break
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        Break;
        Break 1;  ! -> RG311
        Break \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
