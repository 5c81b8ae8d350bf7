MODULE trigg_nowhere
    ! source: S4 datasys 2-TriggL-3: with the robot position at the end point the conditions are
    ! fulfilled immediately and at the same position; 2-MoveLDO-2: when it reaches the stop point
    ! robot: irb120
    ! signal: doNear DO
    ! signal: doTime DO
    ! signal: goDone GO
    ! expect: 1 1 1
    ! expect: 0
    ! expect: 0 behind the corner
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR triggdata near;
    VAR triggdata early;
    VAR triggdata off;

    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        MoveL p, v200, fine, tool0;
        TriggIO near, 20 \DOp:=doNear, 1;
        TriggIO early, 0.2 \Time \DOp:=doTime, 1;
        TriggIO off, 0 \Start \DOp:=doNear, 0;
        TriggL p, v200, near \T2:=early, fine, tool0;
        MoveLGO p, v200, z10, tool0, goDone \Value:=1;
        TPWrite ValToStr(DOutput(doNear)) + " " + ValToStr(DOutput(doTime)) + " " + ValToStr(GOutput(goDone));
        ! The robot is not there yet: behind the corner it is.
        MoveL Offs(p,0,60,0), v200, z20, tool0;
        MoveLGO Offs(p,0,60,0), v200, z20, tool0, goDone \Value:=0;
        IF GOutput(goDone) = 1 TPWrite ValToStr(DOutput(doNear) - 1);
        TriggL Offs(p,0,60,0), v200, off, fine, tool0;
        TPWrite ValToStr(GOutput(goDone) + DOutput(doNear)) + " behind the corner";
    ENDPROC
ENDMODULE
