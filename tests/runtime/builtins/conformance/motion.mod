!=== moves
MODULE moves
    ! source: [manual] S4 MoveL to MoveC, CRobT, CPos, CJointT, CalcJointT, CalcRobT, PDispSet, PDispOn, WaitRob, CirPathMode
    ! robot: irb120
    ! case: unreachable_target=handler
    ! expect: [364.354,0,594] [0.5,0,0.866025,0]
    ! expect: 30 9E+09
    ! expect: [374.354,40,624]
    ! expect: [364.354,0,594]
    ! expect: tool [350.956,-50,544]
    ! expect: [350.956,-70,544]
    ! expect: [364.354,-20,594]
    ! expect: [364.354,0,594] [0.5,0,0.866025,0]
    ! expect: 30
    ! expect: outside reach
    ! expect: its number
    ! In the displaced frame.
    ! expect: [364.354,0,594]
    ! expect: 50
    ! expect: [364.354,0,594]
    ! An active displacement is added to.
    ! expect: [364.354,30,614]
    ! expect: [364.354,50,594]
    ! expect: [364.354,50,594] [0.5,0,0.866025,0]
    ! expect: own
    ! expect: free
    ! Axes 4, 5, 6 = 30, 30, 0 or -150, -30, 180: one pose, two configurations.
    ! expect: -150
    ! expect: -150
    ! expect: 30
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget turned := [[0,0,0,30,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PERS tooldata t := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS wobjdata w := [FALSE,TRUE,"",[[100,0,0],[1,0,0,0]],[[0,50,0],[1,0,0,0]]];
    VAR robtarget q;
    VAR jointtarget j;
    VAR errnum n;
    PROC main()
        MoveAbsJ home, v1000, fine, tool0;
        q := CRobT();
        TPWrite place(q.trans) + " " + turn(q.rot);
        j := CJointT();
        TPWrite ValToStr(Round(j.robax.rax_5 \Dec:=3)) + " " + ValToStr(j.extax.eax_a);
        MoveL Offs(p, 10, 20, 30), v200, z10, tool0;
        MoveC Offs(p, 10, 30, 40), Offs(p, 10, 40, 30), v200, fine, tool0;
        TPWrite place(CPos());
        MoveJ p, v200, fine, tool0;
        TPWrite place(CPos());
        MoveAbsJ home, v1000, fine, tool0;
        q := CRobT(\Tool:=t \WObj:=w);
        TPWrite "tool " + place(q.trans);
        MoveL Offs(q, 0, -20, 0), v200, fine, t \WObj:=w;
        TPWrite place(CPos());
        TPWrite place(CPos(\Tool:=tool0 \WObj:=wobj0));
        j := CalcJointT(p, tool0);
        q := CalcRobT(j, tool0);
        TPWrite place(q.trans) + " " + turn(q.rot);
        TPWrite ValToStr(Round(j.robax.rax_5 \Dec:=3));
        MoveAbsJ home, v1000, fine, tool0;
        MoveJ Offs(p, 3000, 0, 0), v200, fine, tool0;
        j := CalcJointT(Offs(p, 3000, 0, 0), tool0 \ErrorNumber:=n);
        IF n = ERR_OUTSIDE_REACH TPWrite "its number";
        displaced;
        MoveAbsJ home, v1000, fine, tool0;
        MoveL Offs(p, 0, 50, 0), v100, z10, tool0;
        WaitRob \ZeroSpeed;
        TPWrite place(CPos());
        MoveL p, v100, fine, tool0;
        CirPathMode \ObjectFrame;
        MoveC Offs(p, 0, 25, 25), Offs(p, 0, 50, 0), v100, fine, tool0;
        q := CRobT();
        TPWrite place(q.trans) + " " + turn(q.rot);
        StopMove;
        IF IsStopMoveAct(\FromMoveTask) TPWrite "own";
        IF IsStopMoveAct(\FromNonMoveTask) TPWrite "other";
        StartMove;
        IF NOT IsStopMoveAct(\FromMoveTask) TPWrite "free";
        configured;
    ERROR
        IF ERRNO = ERR_OUTSIDE_REACH TPWrite "outside reach";
        TRYNEXT;
    ENDPROC
    PROC displaced()
        MoveAbsJ home, v1000, fine, tool0;
        PDispSet [[0,50,0],[1,0,0,0]];
        MoveL p, v200, fine, tool0;
        TPWrite place(CPos());
        q := ORobT(p);
        TPWrite ValToStr(Round(q.trans.y \Dec:=3));
        MoveAbsJ home, v1000, fine, tool0;
        PDispOff;
        TPWrite place(CPos());
        PDispOn \ExeP:=Offs(p, 0, 30, 0), p, tool0;
        PDispOn \ExeP:=Offs(p, 0, 0, 20), p, tool0;
        MoveL p, v200, fine, tool0;
        PDispOff;
        TPWrite place(CPos());
    ENDPROC
    PROC configured()
        MoveAbsJ turned, v1000, fine, tool0;
        q := CRobT();
        q.robconf := [0,-2,2,1];
        MoveJ q, v500, fine, tool0;
        fourth;
        ConfJ \Off;
        q.robconf := [0,0,0,0];
        MoveJ q, v500, fine, tool0;
        fourth;
        ConfJ \On;
        MoveJ q, v500, fine, tool0;
        fourth;
    ENDPROC
    PROC fourth()
        j := CJointT();
        TPWrite ValToStr(Round(j.robax.rax_4));
    ENDPROC
    FUNC string place(pos here)
        RETURN ValToStr(rounded(here));
    ENDFUNC
    FUNC pos rounded(pos here)
        here := [Round(here.x \Dec:=3),Round(here.y \Dec:=3),Round(here.z \Dec:=3)];
        RETURN here;
    ENDFUNC
    FUNC string turn(orient here)
        here := [Round(here.q1 \Dec:=6),Round(here.q2 \Dec:=6),Round(here.q3 \Dec:=6),Round(here.q4 \Dec:=6)];
        RETURN ValToStr(here);
    ENDFUNC
ENDMODULE
!=== moves_setting
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
!=== unreachable
MODULE unreachable
    ! source: saved event logs of controllers with 5.61 and 6.03: E 50050, no error of the statement, in 9 of 9 cases
    ! robot: irb120
    ! case:
    ! fault: ERR_OUTSIDE_REACH 11
    ! case: unreachable_target=handler
    ! expect: handled
    PROC main()
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        ! 3 m beyond the robot.
        MoveJ [[3364,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    ERROR
        TPWrite "handled";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== no_configuration
MODULE no_configuration
    ! source: [manual 3HAC050917 CalcJointT] ERR_ROBLIMIT: an axis would be outside its range; \ErrorNumber
    ! robot: irb120
    ! case:
    ! expect: handled TRUE FALSE
    ! expect: TRUE FALSE
    ! case: no_configuration=reach
    ! expect: handled FALSE TRUE
    ! expect: FALSE TRUE
    ! case: no_configuration=stop
    ! fault: 50080 18
    PROC main()
        VAR robtarget p;
        VAR jointtarget j;
        VAR errnum number;
        p := CRobT(\Tool:=tool0);
        p.robconf := [3,0,0,0];
        j := CalcJointT(p, tool0);
        j := CalcJointT(p, tool0 \ErrorNumber:=number);
        TPWrite ValToStr(number = ERR_ROBLIMIT) + " " + ValToStr(number = ERR_OUTSIDE_REACH);
    ERROR
        TPWrite "handled " + ValToStr(ERRNO = ERR_ROBLIMIT) + " " + ValToStr(ERRNO = ERR_OUTSIDE_REACH);
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== own_unit
MODULE own_unit
    ! source: [manual] GetServiceInfo; [code] RAPID of open EGM servers: ROB_ID is the robot of the task
    ! robot: irb120
    ! expect: ROB_1 TRUE
    PROC main()
        TPWrite GetMecUnitName(ROB_ID) + " " + ValToStr(IsMechUnitActive(ROB_ID));
    ENDPROC
ENDMODULE
!=== start_move_retry
MODULE start_move_retry
    ! source: [manual 3HAC050917] StartMoveRetry: StartMove and RETRY in one, in an ERROR handler
    ! robot: irb120
    ! fault: 194001 13
    ! expect: try 1
    ! expect: try 2
    ! expect: TRUE FALSE
    VAR num tries := 0;
    PROC main()
        risky;
        TPWrite ValToStr(tries = 2) + " " + ValToStr(IsStopMoveAct(\FromMoveTask));
        StopMove;
        StartMoveRetry;
    ENDPROC
    PROC risky()
        attempt;
    ERROR
        StopMove;
        StartMoveRetry;
        TPWrite "not reached";
    ENDPROC
    PROC attempt()
        tries := tries + 1;
        TPWrite "try " + ValToStr(tries);
        IF tries = 1 RAISE 5;
    ERROR
        RAISE;
    ENDPROC
ENDMODULE
!=== stationary_zones
MODULE stationary_zones
    ! source: [manual] 3HAC050917 wzstationary; without event routines a switch (`stationary_zones`)
    ! robot: irb120
    ! signal: doIn DO
    ! case: stationary_zones=power_on
    ! fault: 194902 13
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
!=== sync_move
MODULE sync_move
    ! source: 3HAC050917 arguments [manual]; list rows without a name: ETH's and Gramazio Kohler's cells [code]; MultiMove [mem]
    ! task: T_ROB2 second
    ! robot: irb120
    ! expect: one FALSE
    ! expect: two TRUE TRUE
    ! expect: suspended FALSE
    ! expect: resumed TRUE
    ! expect: one FALSE FALSE
    ! expect: ERR_SYNCMOVEON
    ! expect: undone FALSE
    PERS tasks both{3} := [["T_ROB1"],["T_ROB2"],[""]];
    VAR syncident begins;
    VAR syncident ends;
    VAR syncident begins_again;
    VAR syncident never;

    PROC main()
        TPWrite "one " \Bool:=IsSyncMoveOn();
        SyncMoveOn begins, both;
        TPWrite "two " + ValToStr(IsSyncMoveOn()) + " " + ValToStr(TasksInSync(both));
        StorePath \KeepSync;
        SyncMoveSuspend;
        TPWrite "suspended " \Bool:=IsSyncMoveOn();
        SyncMoveResume;
        RestoPath;
        TPWrite "resumed " \Bool:=IsSyncMoveOn();
        SyncMoveOff ends;
        TPWrite "one " + ValToStr(IsSyncMoveOn()) + " " + ValToStr(TasksInSync(both));
        SyncMoveOn never, both \TimeOut:=0.5;
        SyncMoveOn begins_again, both;
        SyncMoveUndo;
        TPWrite "undone " \Bool:=IsSyncMoveOn();
    ERROR
        IF ERRNO = ERR_SYNCMOVEON TPWrite "ERR_SYNCMOVEON";
        TRYNEXT;
    ENDPROC

    PROC second()
        WaitTime 0.3;
        SyncMoveOn begins, both;
        StorePath \KeepSync;
        SyncMoveSuspend;
        SyncMoveResume;
        RestoPath;
        WaitTime 0.3;
        SyncMoveOff ends;
        SyncMoveOn begins_again, both;
    ENDPROC
ENDMODULE
!=== touching
MODULE touching
    ! source: [manual] 3HAC050917 ContactL, GetJointData, MaxRobReorientSpeed, CornerPathWarning; SetLeadThrough as public notes of it; [code] HandDriver.sys for EventLog
    ! robot: irb120
    ! do: start, run 30
    ! expect: 500 5000 1000
    ! nothing is touched: with a torque that is an error
    ! expect: 60
    ! expect: no contact
    ! expect: 0
    ! 100 mm/s, the wrist about 305 mm from axis 1
    ! expect: axis 1 turns
    ! expect: 30 0 0 0
    ! led by hand: the robot stands, the path is gone behind
    ! expect: TRUE TRUE TRUE
    ! expect: FALSE FALSE
    ! expect: there
    ! log: 112753 L
    ! warned of one corner, not of the other one
    ! do: pp-to-main, routine warned, start, run 3
    ! log: 50024 Task T_ROB1: the corner at /touching/corner/MoveL/75 became a stop.
    ! do: pp-to-main, routine not_warned, start, run 3
    ! log: 50024
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num place;
    VAR num speed;
    VAR num torque;
    VAR num outer;
    PROC main()
        MoveAbsJ start, v1000, fine, tool0;
        TPWrite ValToStr(MaxRobReorientSpeed()) + " " + ValToStr(MaxExtLinearSpeed()) + " "
            + ValToStr(MaxExtReorientSpeed());
        ContactL Offs(p,0,60,0), v100, tool0;
        tell;
        ContactL \DesiredTorque:=5, p, v100, \Zone:=z1, tool0, \WObj:=wobj0;
        tell;
        MoveL \Conc, Offs(p,0,100,0), v100, fine, tool0;
        WaitTime 0.5;
        GetJointData 1 \Position:=place \Speed:=speed;
        IF place > 8 AND place < 9 AND speed > 18 AND speed < 19 TPWrite "axis 1 turns";
        WaitRob \InPos;
        MoveAbsJ start, v1000, fine, tool0;
        GetJointData \MechUnit:=ROB_1, 5 \Position:=place \Speed:=speed \Torque:=torque \ExtTorque:=outer;
        TPWrite ValToStr(place) + " " + ValToStr(speed) + " " + ValToStr(torque) + " " + ValToStr(outer);
        MoveL \Conc, Offs(p,0,100,0), v100, fine, tool0;
        WaitTime 0.2;
        SetLeadThrough \On;
        WaitTime 1;
        TPWrite ValToStr(IsLeadThrough()) + " " + ValToStr(IsLeadThrough(\Active)) + " "
            + ValToStr(IsStopMoveAct(\FromMoveTask));
        SetLeadThrough \Off;
        TPWrite ValToStr(IsLeadThrough(\Set)) + " " + ValToStr(IsStopMoveAct(\FromMoveTask));
        MoveL p, v100, fine, tool0;
        TPWrite "there";
        EventLog COMMON_ERR, 0, TYPE_STATE, "", "", "", "", "";
        EventLog 11, 2753, TYPE_ERR, ERRSTR_TASK, "L", ERRSTR_CONTEXT, ERRSTR_UNUSED, ERRSTR_UNUSED;
    ERROR
        IF ERRNO = ERR_CONTACTL TPWrite "no contact";
        TRYNEXT;
    ENDPROC
    PROC tell()
        VAR pos here;
        here := CPos(\Tool:=tool0 \WObj:=wobj0);
        TPWrite ValToStr(Round(here.y \Dec:=2));
    ENDPROC
    PROC warned()
        corner;
    ENDPROC
    PROC not_warned()
        CornerPathWarning FALSE;
        corner;
    ENDPROC
    PROC corner()
        MoveAbsJ start, v1000, fine, tool0;
        MoveL Offs(p,0,50,0), v100, z10, tool0;
        WaitTime 1;
    ENDPROC
ENDMODULE
!=== track
MODULE track
    ! source: [manual] S4 MoveExtJ, EOffsSet, GetNextMechUnit, DeactUnit, ActUnit: an external axis
    ! robot: irb120_track
    ! expect: 400 0
    ! expect: 450
    ! expect: ROB_1 TRUE 6
    ! expect: TRACK_1 FALSE 1
    ! expect: STN_1 FALSE 1
    ! expect: off
    ! expect: 0
    ! expect: 100
    VAR jointtarget j;
    VAR num n;
    VAR string name;
    VAR bool robot;
    VAR num count;
    PROC main()
        j := CJointT();
        j.extax.eax_a := 300;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 400;
        MoveExtJ j, vlin100, fine;
        j := CJointT();
        TPWrite ValToStr(Round(j.extax.eax_a \Dec:=3)) + " " + ValToStr(Round(j.robax.rax_1 \Dec:=3));
        EOffsSet [50,0,9E9,9E9,9E9,9E9];
        j.extax.eax_a := 400;
        MoveAbsJ j, v1000, fine, tool0;
        EOffsOff;
        tell;
        WHILE GetNextMechUnit(n, name \TCPRob:=robot \NoOfAxes:=count) DO
            TPWrite name + " " + ValToStr(robot) + " " + ValToStr(count);
        ENDWHILE
        j := CJointT();
        j.extax.eax_a := 0;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 100;
        DeactUnit TRACK_1;
        IF NOT IsMechUnitActive(TRACK_1) TPWrite "off";
        MoveAbsJ j, v1000, fine, tool0;
        tell;
        ActUnit TRACK_1;
        j.extax.eax_a := 100;
        MoveAbsJ j, v1000, fine, tool0;
        tell;
    ENDPROC
    PROC tell()
        j := CJointT();
        TPWrite ValToStr(Round(j.extax.eax_a \Dec:=3));
    ENDPROC
ENDMODULE
!=== world_zones
MODULE world_zones
    ! source: [manual] 3HAC050917 WZDOSet, WZLimSup, WZHomeJointDef, wztemporary: signals by volume and by axes, stationary zones from POWER ON, temporary ones until PP to main
    ! robot: irb120
    ! signal: doIn DO
    ! signal: doNear DO
    ! signal: doHome DO
    ! signal: doClear DO
    ! hook: power_on POWER_ON T_ROB1
    ! do: run 0.1
    ! value: doHome = 0
    ! do: start, run 20
    ! expect: home 1, in 0, near 0, clear 1
    ! the line enters and leaves the box; the signal of \Before comes before that of \Inside
    ! expect: near before in
    ! expect: home 0, in 1, near 1, clear 0
    ! expect: home 0, in 0, near 0, clear 1
    ! disabled, the signal stays; enabled again, it tells the truth
    ! expect: home 0, in 0, near 1, clear 0
    ! expect: home 0, in 1, near 1, clear 0
    ! a freed zone leaves its signal alone, and its datum can be used again
    ! expect: 0
    ! expect: home 0, in 1, near 0, clear 1
    ! supervised, the robot stops before the box at y 50, on its line
    ! state: stopped
    ! log: 194907 rob1 stops before a zone that it must not enter
    ! value: doIn = 1
    ! do: start, run 1
    ! state: stopped
    ! log: 194907 rob1 stops before a zone that it must not enter
    ! PP to main forgets temporary zones; the stationary one stays
    ! do: pp-to-main, routine where, start, run 1
    ! expect: 50
    ! do: pp-to-main, routine aside, start, run 10
    ! expect: home 1, in 1, near 0, clear 0
    ! state: finished
    ! do: power-loss, motors-on, run 0.1
    ! value: doHome = 1
    ! value: home = [2]
    VAR wztemporary box;
    VAR wztemporary near;
    VAR wztemporary clear;
    VAR wztemporary wall;
    PERS wzstationary home := [2];
    VAR clock since;
    VAR intnum i;
    CONST jointtarget start := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC power_on()
        VAR shapedata posture;
        WZHomeJointDef \Inside, posture, start, [[2,2,2,2,2,2],[9E9,9E9,9E9,9E9,9E9,9E9]];
        keep home, posture;
    ENDPROC
    PROC keep(INOUT wzstationary zone, VAR shapedata posture)
        WZDOSet \Stat, zone \Inside, posture, doHome, 1;
    ENDPROC
    TRAP came
        IF doNear = 1 AND doIn = 0 TPWrite "near before in";
    ENDTRAP
    PROC main()
        VAR shapedata volume;
        VAR shapedata around;
        MoveAbsJ start, v1000, fine, tool0;
        WZBoxDef \Inside, volume, [1000,90,1000], [0,50,0];
        WZDOSet \Temp, box \Inside, volume, doIn, 1;
        WZDOSet \Temp, near \Before, volume, doNear, 1;
        WZSphDef \Outside, around, [364.354,70,594], 30;
        WZDOSet \Temp, clear \Inside, around, doClear, 1;
        tell;
        CONNECT i WITH came;
        ISignalDO \Single, doNear, 1, i;
        MoveL Offs(p,0,70,0), v1000, fine, tool0;
        tell;
        MoveL Offs(p,0,140,0), v1000, fine, tool0;
        tell;
        WZDisable box;
        MoveL Offs(p,0,70,0), v1000, fine, tool0;
        tell;
        WZEnable box;
        tell;
        WZFree box;
        TPWrite ValToStr(box.wz);
        MoveL Offs(p,0,0,0), v1000, fine, tool0;
        MoveL Offs(p,0,30,0), v1000, fine, tool0;
        tell;
        WZLimSup \Temp, wall, volume;
        MoveL Offs(p,0,140,0), v200, fine, tool0;
    ENDPROC
    PROC where()
        VAR pos here;
        here := CPos(\Tool:=tool0 \WObj:=wobj0);
        TPWrite ValToStr(Round(here.y \Dec:=3));
    ENDPROC
    PROC aside()
        MoveL Offs(p,0,70,0), v1000, fine, tool0;
        MoveAbsJ start, v1000, fine, tool0;
        tell;
    ENDPROC
    PROC tell()
        TPWrite "home " + ValToStr(doHome) + ", in " + ValToStr(doIn) + ", near "
            + ValToStr(doNear) + ", clear " + ValToStr(doClear);
    ENDPROC
ENDMODULE
