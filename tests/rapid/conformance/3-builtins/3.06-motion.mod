!=== accset
! rule: arguments of AccSet
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        AccSet 1, 1;
        AccSet 1, 1 \FinePointRamp:=1;
        AccSet 1;  ! -> RG311
        AccSet 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== actunit
! rule: arguments of ActUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        ActUnit v_mecunit;
        ActUnit;  ! -> RG311?
        ActUnit v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== calcjointt
! rule: arguments of CalcJointT
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR jointtarget r_jointtarget;
    PERS wobjdata p_wobjdata;
    VAR errnum v_errnum;
    PROC main()
        r_jointtarget := CalcJointT(v_robtarget, p_tooldata);
        r_jointtarget := CalcJointT(\UseCurWObjPos, v_robtarget, p_tooldata \WObj:=p_wobjdata \ErrorNumber:=v_errnum);
        r_jointtarget := CalcJointT(v_robtarget);  ! -> RG311
        r_jointtarget := CalcJointT(v_robtarget, p_tooldata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== calcrobt
! rule: arguments of CalcRobT
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    VAR robtarget r_robtarget;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata);
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CalcRobT(v_jointtarget);  ! -> RG311
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== cjointt
! rule: arguments of CJointT
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget r_jointtarget;
    VAR taskid v_taskid;
    PROC main()
        r_jointtarget := CJointT();
        r_jointtarget := CJointT(\TaskRef:=v_taskid);
        r_jointtarget := CJointT(\TaskName:="x");
        r_jointtarget := CJointT(1);  ! -> RG311
        r_jointtarget := CJointT(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== clearpath
! rule: arguments of ClearPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ClearPath;
        ClearPath 1;  ! -> RG311
        ClearPath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== confj
! rule: arguments of ConfJ
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ConfJ;
        ConfJ \On;
        ConfJ \Off;
        ConfJ 1;  ! -> RG311
        ConfJ \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== confl
! rule: arguments of ConfL
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ConfL;
        ConfL \On;
        ConfL \Off;
        ConfL 1;  ! -> RG311
        ConfL \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== cpos
! rule: arguments of CPos
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos r_pos;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_pos := CPos();
        r_pos := CPos(\Tool:=p_tooldata \WObj:=p_wobjdata);
        r_pos := CPos(1);  ! -> RG311
        r_pos := CPos(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== crobt
! rule: arguments of CRobT
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget r_robtarget;
    VAR taskid v_taskid;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_robtarget := CRobT();
        r_robtarget := CRobT(\TaskRef:=v_taskid \Tool:=p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CRobT(\TaskName:="x" \Tool:=p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CRobT(1);  ! -> RG311
        r_robtarget := CRobT(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== cspeedoverride
! rule: arguments of CSpeedOverride
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := CSpeedOverride();
        r_num := CSpeedOverride(\CTask);
        r_num := CSpeedOverride(1);  ! -> RG311
        r_num := CSpeedOverride(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== ctool
! rule: arguments of CTool
! source: [manual] 3HAC050917
MODULE Demo
    VAR tooldata r_tooldata;
    VAR taskid v_taskid;
    PROC main()
        r_tooldata := CTool();
        r_tooldata := CTool(\TaskRef:=v_taskid);
        r_tooldata := CTool(\TaskName:="x");
        r_tooldata := CTool(1);  ! -> RG311
        r_tooldata := CTool(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== cwobj
! rule: arguments of CWObj
! source: [manual] 3HAC050917
MODULE Demo
    VAR wobjdata r_wobjdata;
    VAR taskid v_taskid;
    PROC main()
        r_wobjdata := CWObj();
        r_wobjdata := CWObj(\TaskRef:=v_taskid);
        r_wobjdata := CWObj(\TaskName:="x");
        r_wobjdata := CWObj(1);  ! -> RG311
        r_wobjdata := CWObj(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== deactunit
! rule: arguments of DeactUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        DeactUnit v_mecunit;
        DeactUnit;  ! -> RG311?
        DeactUnit v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== eoffsoff
! rule: arguments of EOffsOff
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        EOffsOff;
        EOffsOff 1;  ! -> RG311
        EOffsOff \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== eoffson
! rule: arguments of EOffsOn
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PROC main()
        EOffsOn v_robtarget;
        EOffsOn \ExeP:=v_robtarget, v_robtarget;
        EOffsOn;  ! -> RG311?
        EOffsOn v_robtarget \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== eoffsset
! rule: arguments of EOffsSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR extjoint v_extjoint;
    PROC main()
        EOffsSet v_extjoint;
        EOffsSet;  ! -> RG311?
        EOffsSet v_extjoint \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== getmotortorque
! rule: arguments of GetMotorTorque
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR mecunit v_mecunit;
    PROC main()
        r_num := GetMotorTorque(1);
        r_num := GetMotorTorque(\MecUnit:=v_mecunit, 1);
        r_num := GetMotorTorque();  ! -> RG311
        r_num := GetMotorTorque(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== getnextmechunit
! rule: arguments of GetNextMechUnit
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    VAR bool r_bool;
    VAR mecunit v_mecunit;
    VAR bool v_bool;
    PROC main()
        r_bool := GetNextMechUnit(v_num, v_string);
        r_bool := GetNextMechUnit(v_num, v_string \MecRef:=v_mecunit \TCPRob:=v_bool \NoOfAxes:=v_num \MecTaskNo:=v_num \MotPlanNo:=v_num \Active:=v_bool \DriveModule:=v_num \OKToDeact:=v_bool);
        r_bool := GetNextMechUnit(v_num);  ! -> RG311
        r_bool := GetNextMechUnit(v_num, v_string \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== gripload
! rule: arguments of GripLoad
! source: [manual] 3HAC050917
MODULE Demo
    PERS loaddata p_loaddata;
    PROC main()
        GripLoad p_loaddata;
        GripLoad;  ! -> RG311?
        GripLoad p_loaddata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== ismechunitactive
! rule: arguments of IsMechUnitActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR bool r_bool;
    PROC main()
        r_bool := IsMechUnitActive(v_mecunit);
        r_bool := IsMechUnitActive();  ! -> RG311
        r_bool := IsMechUnitActive(v_mecunit \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== isstopmoveact
! rule: arguments of IsStopMoveAct
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsStopMoveAct();
        r_bool := IsStopMoveAct(\FromMoveTask);
        r_bool := IsStopMoveAct(\FromNonMoveTask);
        r_bool := IsStopMoveAct(1);  ! -> RG311
        r_bool := IsStopMoveAct(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== maxrobspeed
! rule: arguments of MaxRobSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := MaxRobSpeed();
        r_num := MaxRobSpeed(1);  ! -> RG311
        r_num := MaxRobSpeed(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== motionsup
! rule: arguments of MotionSup
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        MotionSup;
        MotionSup \On \Tunevalue:=1 \NoBackoff;
        MotionSup \Off \Tunevalue:=1 \NoBackoff;
        MotionSup 1;  ! -> RG311
        MotionSup \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== moveabsj
! rule: arguments of MoveAbsJ
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveAbsJ v_jointtarget, v100, z10, p_tooldata;
        MoveAbsJ \Conc, v_jointtarget \ID:=1 \NoEOffs, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveAbsJ \Conc, v_jointtarget \ID:=1 \NoEOffs, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveAbsJ v_jointtarget, v100, z10;  ! -> RG311
        MoveAbsJ v_jointtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movec
! rule: arguments of MoveC
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveC v_robtarget, v_robtarget, v100, z10, p_tooldata;
        MoveC \Conc, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveC \Conc, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveC v_robtarget, v_robtarget, v100, z10;  ! -> RG311
        MoveC v_robtarget, v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movecdo
! rule: arguments of MoveCDO
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR signaldo s;
    PROC main()
        MoveCDO p, p, v100, z10, tool0, s, 1;
        MoveCDO p, p \ID:=1, v100 \T:=1, z10, tool0 \WObj:=w, s, high \TLoad:=l;
        MoveCDO p, p, v100, z10, tool0, s;  ! -> RG311
    ENDPROC
ENDMODULE
!=== moveextj
! rule: arguments of MoveExtJ
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PROC main()
        MoveExtJ v_jointtarget, v100, z10;
        MoveExtJ \Conc, v_jointtarget \ID:=1 \UseEOffs, v100 \T:=1, z10 \Inpos:=inpos50;
        MoveExtJ v_jointtarget, v100;  ! -> RG311
        MoveExtJ v_jointtarget, v100, z10 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movej
! rule: arguments of MoveJ
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveJ v_robtarget, v100, z10, p_tooldata;
        MoveJ \Conc, v_robtarget \ID:=1, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveJ \Conc, v_robtarget \ID:=1, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata;
        MoveJ v_robtarget, v100, z10;  ! -> RG311
        MoveJ v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movejdo
! rule: arguments of MoveJDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR signaldo v_signaldo;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo, 1;
        MoveJDO v_robtarget \ID:=1, v100 \T:=1, z10, p_tooldata \WObj:=p_wobjdata, v_signaldo, 1 \TLoad:=p_loaddata;
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo;  ! -> RG311
        MoveJDO v_robtarget, v100, z10, p_tooldata, v_signaldo, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movel
! rule: arguments of MoveL
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveL v_robtarget, v100, z10, p_tooldata;
        MoveL \Conc, v_robtarget \ID:=1, v100 \V:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveL \Conc, v_robtarget \ID:=1, v100 \T:=1, z10 \Z:=1 \Inpos:=inpos50, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        MoveL v_robtarget, v100, z10;  ! -> RG311
        MoveL v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== moveldo
! rule: arguments of MoveLDO
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    VAR signaldo s;
    PROC main()
        MoveLDO p, v100, z10, tool0, s, 1;
        MoveLDO p \ID:=1, v100 \T:=1, z10, tool0 \WObj:=w, s, high \TLoad:=l;
        MoveLDO p, v100, z10, tool0, s;  ! -> RG311
    ENDPROC
ENDMODULE
!=== movelsync
! rule: arguments of MoveLSync
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        MoveLSync v_robtarget, v100, z10, p_tooldata, "x";
        MoveLSync v_robtarget \ID:=1, v100 \T:=1, z10, p_tooldata \WObj:=p_wobjdata, "x" \TLoad:=p_loaddata;
        MoveLSync v_robtarget, v100, z10, p_tooldata;  ! -> RG311
        MoveLSync v_robtarget, v100, z10, p_tooldata, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathacclim
! rule: arguments of PathAccLim
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathAccLim TRUE, TRUE;
        PathAccLim TRUE \AccMax:=1, TRUE \DecelMax:=1;
        PathAccLim TRUE;  ! -> RG311
        PathAccLim TRUE, TRUE \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathlevel
! rule: arguments of PathLevel
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := PathLevel();
        r_num := PathLevel(1);  ! -> RG311
        r_num := PathLevel(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathrecmovebwd
! rule: arguments of PathRecMoveBwd
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecMoveBwd;
        PathRecMoveBwd \ID:=v_pathrecid \ToolOffs:=[1, 2, 3] \Speed:=v100;
        PathRecMoveBwd 1;  ! -> RG311
        PathRecMoveBwd \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathrecmovefwd
! rule: arguments of PathRecMoveFwd
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecMoveFwd;
        PathRecMoveFwd \ID:=v_pathrecid \ToolOffs:=[1, 2, 3] \Speed:=v100;
        PathRecMoveFwd 1;  ! -> RG311
        PathRecMoveFwd \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathrecstart
! rule: arguments of PathRecStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR pathrecid v_pathrecid;
    PROC main()
        PathRecStart v_pathrecid;
        PathRecStart;  ! -> RG311?
        PathRecStart v_pathrecid \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathrecstop
! rule: arguments of PathRecStop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathRecStop;
        PathRecStop \Clear;
        PathRecStop 1;  ! -> RG311
        PathRecStop \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pathresol
! rule: arguments of PathResol
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PathResol 1;
        PathResol;  ! -> RG311?
        PathResol 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pdispoff
! rule: arguments of PDispOff
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        PDispOff;
        PDispOff 1;  ! -> RG311
        PDispOff \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== pdispon
! rule: arguments of PDispOn
! source: [manual] 3HAC050917
MODULE Demo
    CONST robtarget p := [[0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0]];
    PERS wobjdata w;
    PERS loaddata l;
    PROC main()
        PDispOn p, tool0;
        PDispOn \Rot \ExeP:=p, p, tool0 \WObj:=w;
        PDispOn p;  ! -> RG311
    ENDPROC
ENDMODULE
!=== pdispset
! rule: arguments of PDispSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    PROC main()
        PDispSet v_pose;
        PDispSet;  ! -> RG311?
        PDispSet v_pose \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readmotor
! rule: arguments of ReadMotor
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR mecunit v_mecunit;
    PROC main()
        r_num := ReadMotor(1);
        r_num := ReadMotor(\MecUnit:=v_mecunit, 1);
        r_num := ReadMotor();  ! -> RG311
        r_num := ReadMotor(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== restopath
! rule: arguments of RestoPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RestoPath;
        RestoPath 1;  ! -> RG311
        RestoPath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== searchc
! rule: arguments of SearchC
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR signaldi v_signaldi;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        SearchC v_signaldi, v_robtarget, v_robtarget, v_robtarget, v100, p_tooldata;
        SearchC \Stop, v_signaldi \Flanks, v_robtarget, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchC \PStop, p_bool \PosFlank, v_robtarget, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchC \SStop, v_signaldi \NegFlank, v_robtarget, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchC \Sup, p_bool \HighLevel, v_robtarget, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchC \Stop, v_signaldi \LowLevel, v_robtarget, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchC v_signaldi, v_robtarget, v_robtarget, v_robtarget, v100;  ! -> RG311
        SearchC v_signaldi, v_robtarget, v_robtarget, v_robtarget, v100, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== searchl
! rule: arguments of SearchL
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR signaldi v_signaldi;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        SearchL v_signaldi, v_robtarget, v_robtarget, v100, p_tooldata;
        SearchL \Stop, v_signaldi \Flanks, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \PStop, p_bool \PosFlank, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \SStop, v_signaldi \NegFlank, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \Sup, p_bool \HighLevel, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \Stop, v_signaldi \LowLevel, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL v_signaldi, v_robtarget, v_robtarget, v100;  ! -> RG311
        SearchL v_signaldi, v_robtarget, v_robtarget, v100, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== singarea
! rule: arguments of SingArea
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SingArea;
        SingArea \Wrist;
        SingArea \LockAxis4;
        SingArea \Off;
        SingArea 1;  ! -> RG311
        SingArea \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== softact
! rule: arguments of SoftAct
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        SoftAct 1, 1;
        SoftAct \MechUnit:=v_mecunit, 1, 1 \Ramp:=1;
        SoftAct 1;  ! -> RG311
        SoftAct 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== softdeact
! rule: arguments of SoftDeact
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SoftDeact;
        SoftDeact \Ramp:=1;
        SoftDeact 1;  ! -> RG311
        SoftDeact \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== speedlimaxis
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
!=== speedlimcheckpoint
! rule: arguments of SpeedLimCheckPoint
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpeedLimCheckPoint 1;
        SpeedLimCheckPoint;  ! -> RG311?
        SpeedLimCheckPoint 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== speedrefresh
! rule: arguments of SpeedRefresh
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpeedRefresh 1;
        SpeedRefresh;  ! -> RG311?
        SpeedRefresh 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== startmove
! rule: arguments of StartMove
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StartMove;
        StartMove \AllMotionTasks;
        StartMove 1;  ! -> RG311
        StartMove \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stepbwdpath
! rule: arguments of StepBwdPath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StepBwdPath 1, 1;
        StepBwdPath 1;  ! -> RG311
        StepBwdPath 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stopmove
! rule: arguments of StopMove
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StopMove;
        StopMove \Quick \AllMotionTasks;
        StopMove 1;  ! -> RG311
        StopMove \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stopmovereset
! rule: arguments of StopMoveReset
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StopMoveReset;
        StopMoveReset \AllMotionTasks;
        StopMoveReset 1;  ! -> RG311
        StopMoveReset \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== storepath
! rule: arguments of StorePath
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StorePath;
        StorePath \KeepSync;
        StorePath 1;  ! -> RG311
        StorePath \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== velset
! rule: arguments of VelSet
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        VelSet 1, 1;
        VelSet 1;  ! -> RG311
        VelSet 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== worldacclim
! rule: arguments of WorldAccLim
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WorldAccLim;
        WorldAccLim \On:=1;
        WorldAccLim \Off;
        WorldAccLim 1;  ! -> RG311
        WorldAccLim \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
