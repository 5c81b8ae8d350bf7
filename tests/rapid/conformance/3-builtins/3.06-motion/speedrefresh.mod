! rule: arguments of SpeedRefresh
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpeedRefresh 1;
        SpeedRefresh;  ! -> RG311?
        SpeedRefresh 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
