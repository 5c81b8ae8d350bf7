! rule: arguments of SpeedLimAxis
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        SpeedLimAxis v_mecunit, 1, 1;
        SpeedLimAxis v_mecunit, 1;  ! -> RG311
        SpeedLimAxis v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
