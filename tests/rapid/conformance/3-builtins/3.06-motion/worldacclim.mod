! rule: arguments of WorldAccLim
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WorldAccLim;
        WorldAccLim \On:=1;
        WorldAccLim \Off;
        WorldAccLim 1;  ! -> RG311
        WorldAccLim \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
