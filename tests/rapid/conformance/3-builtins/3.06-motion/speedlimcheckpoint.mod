! rule: arguments of SpeedLimCheckPoint
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpeedLimCheckPoint 1;
        SpeedLimCheckPoint;  ! -> RG311?
        SpeedLimCheckPoint 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
