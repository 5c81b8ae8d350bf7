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
