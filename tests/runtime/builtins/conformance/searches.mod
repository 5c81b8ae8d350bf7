!=== search_external
MODULE search_external
    ! source: [manual] 3HAC050917 SearchExtJ: as SearchL, with external axes alone
    ! robot: irb120_track
    ! expect: found TRUE at 250
    ! expect: none
    ! expect: 400
    PERS bool hit := FALSE;
    VAR jointtarget j;
    VAR jointtarget found;
    VAR intnum i;
    TRAP comes
        hit := TRUE;
    ENDTRAP
    PROC main()
        j := CJointT();
        j.extax.eax_a := 200;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 300;
        CONNECT i WITH comes;
        ITimer \Single, 0.5, i;
        SearchExtJ \SStop, hit, found, j, vlin100;
        TPWrite "found " + ValToStr(found.extax.eax_a > 240 AND found.extax.eax_a < 260) + " at "
            + ValToStr(Round(found.extax.eax_a / 50) * 50);
        j.extax.eax_a := 400;
        hit := FALSE;
        SearchExtJ hit, found, j, vlin100;
    ERROR
        IF ERRNO = ERR_WHLSEARCH THEN
            TPWrite "none";
            found := CJointT();
            TPWrite ValToStr(Round(found.extax.eax_a));
            TRYNEXT;
        ENDIF
    ENDPROC
ENDMODULE
!=== searches
MODULE searches
    ! source: [manual] S4 datasys 2-SearchL: no hit keeps the point, a signal that is high is an error; StorePath in a trap
    ! robot: irb120
    ! expect: none
    ! expect: 0
    ! expect: 50
    ! expect: high
    ! expect: 0
    ! StopMove, StorePath, moves, RestoPath, StartMove
    ! expect: level 2
    ! expect: 100 594
    ! expect: level 1
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PERS bool hit := FALSE;
    VAR robtarget q;
    VAR intnum i;
    TRAP aside
        VAR robtarget here;
        StopMove;
        StorePath;
        here := CRobT(\Tool:=tool0);
        MoveL Offs(here, 0, 0, 30), v200, fine, tool0;
        TPWrite "level " \Num:=PathLevel();
        MoveL here, v200, fine, tool0;
        RestoPath;
        StartMove;
    ENDTRAP
    PROC main()
        MoveAbsJ home, v1000, fine, tool0;
        q := p;
        SearchL \PStop, hit, q, Offs(p, 0, 50, 0), v200, tool0;
        TPWrite ValToStr(q.trans.y);
        tell;
        MoveAbsJ home, v1000, fine, tool0;
        hit := TRUE;
        SearchL \Stop, hit, q, Offs(p, 0, 50, 0), v200, tool0;
        tell;
        CONNECT i WITH aside;
        ITimer \Single, 0.5, i;
        MoveL Offs(p, 0, 100, 0), v100, fine, tool0;
        q := CRobT();
        TPWrite ValToStr(Round(q.trans.y \Dec:=3)) + " " + ValToStr(Round(q.trans.z \Dec:=3));
        TPWrite "level " \Num:=PathLevel();
    ERROR
        IF ERRNO = ERR_WHLSEARCH TPWrite "none";
        IF ERRNO = ERR_SIGSUPSEARCH TPWrite "high";
        TRYNEXT;
    ENDPROC
    PROC tell()
        VAR pos here;
        here := CPos();
        TPWrite ValToStr(Round(here.y \Dec:=3));
    ENDPROC
ENDMODULE
!=== moves_without_store_path
MODULE moves_without_store_path
    ! source: log of an IRB 120 with 5.15: 41739 (task, "MoveL", "StorePath", place) for each move of a trap, which is executed; error handlers [mem]
    ! robot: irb120
    ! do: start, run 30
    ! expect: trap 40
    ! expect: end 0
    ! expect: handler 0
    ! log: 41739 Task T_ROB1: MoveL in a trap or error handler without StorePath, at /moves_without_store_path/aside/MoveL/13.; 41739 Task T_ROB1: MoveJ in a trap or error handler without StorePath, at /moves_without_store_path/back/MoveJ/42.
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR intnum i;
    TRAP aside
        MoveL Offs(p, 0, 40, 0), v200, fine, tool0;
        tell "trap";
    ENDTRAP
    TRAP kept
        StopMove;
        StorePath;
        MoveL CRobT(\Tool:=tool0), v200, fine, tool0;
        RestoPath;
        StartMove;
    ENDTRAP
    PROC main()
        VAR num zero := 0;
        MoveAbsJ home, v1000, fine, tool0;
        CONNECT i WITH aside;
        ITimer \Single, 0.5, i;
        WaitTime 3;
        MoveL p, v200, fine, tool0;
        tell "end";
        IDelete i;
        CONNECT i WITH kept;
        ITimer \Single, 0.5, i;
        MoveL Offs(p, 0, 100, 0), v100, fine, tool0;
        zero := 1 / zero;
        tell "handler";
    ERROR
        back;
        TRYNEXT;
    ENDPROC
    PROC back()
        MoveJ p, v200, fine, tool0;
    ENDPROC
    PROC tell(string where)
        VAR pos here;
        here := CPos();
        TPWrite where + " " + ValToStr(Round(here.y));
    ENDPROC
ENDMODULE
!=== trigg_data
MODULE trigg_data
    ! source: 3HAC050917 TriggDataReset, TriggDataCopy, TriggDataValid [manual]
    ! robot: irb120
    ! signal: doFirst DO
    ! signal: doSecond DO
    ! expect: FALSE
    ! expect: TRUE TRUE
    ! expect: FALSE TRUE
    ! expect: 1 0
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR triggdata one;
    VAR triggdata other;

    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        TPWrite ValToStr(TriggDataValid(one));
        TriggIO one, 20 \DOp:=doFirst, 1;
        TriggDataCopy one, other;
        TPWrite ValToStr(TriggDataValid(one)) + " " + ValToStr(TriggDataValid(other));
        TriggDataReset one;
        TPWrite ValToStr(TriggDataValid(one)) + " " + ValToStr(TriggDataValid(other));
        TriggIO one, 20 \DOp:=doSecond, 1;
        TriggL Offs(p,0,60,0), v200, other, fine, tool0;
        TPWrite ValToStr(DOutput(doFirst)) + " " + ValToStr(DOutput(doSecond));
    ENDPROC
ENDMODULE
!=== trigg_nowhere
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
