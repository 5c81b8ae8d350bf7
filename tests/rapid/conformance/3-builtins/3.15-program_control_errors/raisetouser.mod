! rule: arguments of RaiseToUser
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RaiseToUser;
        RaiseToUser \Continue \ErrorNumber:=1;
        RaiseToUser \BreakOff \ErrorNumber:=1;
        RaiseToUser 1;  ! -> RG311
        RaiseToUser \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
