MODULE stationary_zones
    ! source: [manual] 3HAC050917 wzstationary; without event routines a switch (`stationary_zones`)
    ! robot: irb120
    ! signal: doIn DO
    ! case: stationary_zones=power_on
    ! fault: 49902 13
    ! case: stationary_zones=anywhere
    ! expect: 1
    VAR wzstationary zone;
    PROC main()
        VAR shapedata volume;
        WZSphDef \Outside, volume, [0,0,0], 50;
        WZDOSet \Stat, zone \Inside, volume, doIn, 1;
        TPWrite ValToStr(doIn);
    ENDPROC
ENDMODULE
