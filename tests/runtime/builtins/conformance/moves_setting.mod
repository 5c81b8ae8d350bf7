MODULE moves_setting
    ! source: 3HAC050917 MoveLAO, MoveLGO for arguments [manual]; S4 datasys 2-MoveLDO for when
    ! robot: irb120
    ! signal: aoSpeed AO
    ! signal: goTool GO
    ! signal: doDone DO
    ! expect: 0
    ! expect: 2.5 before the corner's end
    ! expect: 1 1
    ! expect: beyond
    ! expect: beyond
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        TPWrite ValToStr(AOutput(aoSpeed));
        MoveLAO Offs(p,0,60,0), v200, z20, tool0, aoSpeed, 2.5;
        MoveL Offs(p,0,60,40), v200, z20, tool0;
        WaitUntil AOutput(aoSpeed) = 2.5 \MaxTime:=5;
        TPWrite ValToStr(AOutput(aoSpeed)) + " before the corner's end";
        MoveJGO Offs(p,0,60,60), v200, fine, tool0, goTool \Dvalue:=1;
        MoveCDO Offs(p,0,50,70), Offs(p,0,40,60), v200, fine, tool0, doDone, 1;
        TPWrite ValToStr(GOutput(goTool)) + " " + ValToStr(DOutput(doDone));
        MoveLGO p, v200, fine, tool0, goTool \Value:=2;
        MoveLGO p, v200, fine, tool0, goTool \Value:=-1;
    ERROR
        IF ERRNO = ERR_GO_LIM TPWrite "beyond";
        TRYNEXT;
    ENDPROC
ENDMODULE
