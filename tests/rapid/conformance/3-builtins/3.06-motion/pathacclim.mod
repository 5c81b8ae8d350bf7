! rule: arguments of PathAccLim
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathAccLim TRUE, TRUE;
        PathAccLim TRUE \AccMax:=1, TRUE \DecelMax:=1;
        PathAccLim TRUE;  ! -> RG311
        PathAccLim TRUE, TRUE \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
