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
    ! log: 49907 rob1 stops before a zone that it must not enter
    ! value: doIn = 1
    ! do: start, run 1
    ! state: stopped
    ! log: 49907 rob1 stops before a zone that it must not enter
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
