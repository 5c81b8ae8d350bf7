!=== argname
! rule: arguments of ArgName
! source: [manual] 3HAC050917
MODULE Demo
    VAR errnum v_errnum;
    VAR num v_num;
    VAR string r;
    PROC main()
        r := ArgName(v_num);
        r := ArgName(v_num \ErrorNumber:=v_errnum);
        r := ArgName();  ! -> RG311
        r := ArgName(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== calcrotaxframez
! rule: arguments of CalcRotAxFrameZ
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR pose r;
    VAR robtarget v_robtarget;
    VAR robtarget v_robtarget_array{2};
    PROC main()
        r := CalcRotAxFrameZ(v_robtarget_array, 1, v_robtarget, v_num, v_num);
        r := CalcRotAxFrameZ();  ! -> RG311
        r := CalcRotAxFrameZ(v_robtarget_array, 1, v_robtarget, v_num, v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== calcrotaxisframe
! rule: arguments of CalcRotAxisFrame
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR pose r;
    VAR robtarget v_robtarget_array{2};
    PROC main()
        r := CalcRotAxisFrame(v_mecunit, v_robtarget_array, 1, v_num, v_num);
        r := CalcRotAxisFrame(v_mecunit \AxisNo:=1, v_robtarget_array, 1, v_num, v_num);
        r := CalcRotAxisFrame();  ! -> RG311
        r := CalcRotAxisFrame(v_mecunit, v_robtarget_array, 1, v_num, v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== camflush
! rule: arguments of CamFlush
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamFlush v_cameradev;
        CamFlush;  ! -> RG311?
        CamFlush v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camgetname
! rule: arguments of CamGetName
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR string r;
    PROC main()
        r := CamGetName(v_cameradev);
        r := CamGetName();  ! -> RG311
        r := CamGetName(v_cameradev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== camgetparameter
! rule: arguments of CamGetParameter
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR cameradev v_cameradev;
    VAR num v_num;
    PROC main()
        CamGetParameter v_cameradev, "x";
        CamGetParameter v_cameradev, "x" \NumVar:=v_num;
        CamGetParameter v_cameradev, "x" \BoolVar:=v_bool;
        CamGetParameter;  ! -> RG311?
        CamGetParameter v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camloadjob
! rule: arguments of CamLoadJob
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamLoadJob v_cameradev, "x";
        CamLoadJob v_cameradev, "x" \KeepTargets \MaxTime:=1;
        CamLoadJob;  ! -> RG311?
        CamLoadJob v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camnumberofresults
! rule: arguments of CamNumberOfResults
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR num r;
    PROC main()
        r := CamNumberOfResults(v_cameradev);
        r := CamNumberOfResults(v_cameradev \SceneId:=1);
        r := CamNumberOfResults();  ! -> RG311
        r := CamNumberOfResults(v_cameradev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== camreqimage
! rule: arguments of CamReqImage
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    VAR num v_num;
    PROC main()
        CamReqImage v_cameradev;
        CamReqImage v_cameradev \SceneId:=v_num \KeepTargets \AwaitComplete;
        CamReqImage;  ! -> RG311?
        CamReqImage v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camsetexposure
! rule: arguments of CamSetExposure
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetExposure v_cameradev;
        CamSetExposure v_cameradev \ExposureTime:=1 \Brightness:=1 \Contrast:=1;
        CamSetExposure;  ! -> RG311?
        CamSetExposure v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camsetparameter
! rule: arguments of CamSetParameter
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetParameter v_cameradev, "x";
        CamSetParameter v_cameradev, "x" \NumVal:=1;
        CamSetParameter v_cameradev, "x" \BoolVal:=TRUE;
        CamSetParameter;  ! -> RG311?
        CamSetParameter v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camsetprogrammode
! rule: arguments of CamSetProgramMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetProgramMode v_cameradev;
        CamSetProgramMode;  ! -> RG311?
        CamSetProgramMode v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camsetrunmode
! rule: arguments of CamSetRunMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamSetRunMode v_cameradev;
        CamSetRunMode;  ! -> RG311?
        CamSetRunMode v_cameradev \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== camstartloadjob
! rule: arguments of CamStartLoadJob
! source: [manual] 3HAC050917
MODULE Demo
    VAR cameradev v_cameradev;
    PROC main()
        CamStartLoadJob v_cameradev, "x";
        CamStartLoadJob v_cameradev, "x" \KeepTargets;
        CamStartLoadJob;  ! -> RG311?
        CamStartLoadJob v_cameradev, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== dropsensor
! rule: arguments of DropSensor
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        DropSensor v_mecunit;
        DropSensor;  ! -> RG311?
        DropSensor v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== dropwobj
! rule: arguments of DropWObj
! source: [manual] 3HAC050917
MODULE Demo
    PERS wobjdata p_wobjdata;
    PROC main()
        DropWObj p_wobjdata;
        DropWObj;  ! -> RG311?
        DropWObj p_wobjdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== getsysdata
! rule: arguments of GetSysData
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    VAR taskid v_taskid;
    PERS num p_num;
    PROC main()
        GetSysData p_num;
        GetSysData \TaskRef:=v_taskid, p_num \ObjectName:=v_string;
        GetSysData \TaskName:="x", p_num \ObjectName:=v_string;
        GetSysData;  ! -> RG311?
        GetSysData p_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== indamove
! rule: arguments of IndAMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndAMove v_mecunit, 1, 1;
        IndAMove v_mecunit, 1 \ToAbsPos:=v_robtarget, 1 \Ramp:=1;
        IndAMove v_mecunit, 1 \ToAbsNum:=1, 1 \Ramp:=1;
        IndAMove;  ! -> RG311?
        IndAMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== indcmove
! rule: arguments of IndCMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        IndCMove v_mecunit, 1, 1;
        IndCMove v_mecunit, 1, 1 \Ramp:=1;
        IndCMove;  ! -> RG311?
        IndCMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== inddmove
! rule: arguments of IndDMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        IndDMove v_mecunit, 1, 1, 1;
        IndDMove v_mecunit, 1, 1, 1 \Ramp:=1;
        IndDMove;  ! -> RG311?
        IndDMove v_mecunit, 1, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== indinpos
! rule: arguments of IndInpos
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR mecunit v_mecunit;
    PROC main()
        r := IndInpos(v_mecunit, 1);
        r := IndInpos();  ! -> RG311
        r := IndInpos(v_mecunit, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== indreset
! rule: arguments of IndReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndReset v_mecunit, 1;
        IndReset v_mecunit, 1 \RefPos:=v_robtarget \Short;
        IndReset v_mecunit, 1 \RefNum:=1 \Fwd;
        IndReset;  ! -> RG311?
        IndReset v_mecunit, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== indrmove
! rule: arguments of IndRMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR robtarget v_robtarget;
    PROC main()
        IndRMove v_mecunit, 1, 1;
        IndRMove v_mecunit, 1 \ToRelPos:=v_robtarget \Short, 1 \Ramp:=1;
        IndRMove v_mecunit, 1 \ToRelNum:=1 \Fwd, 1 \Ramp:=1;
        IndRMove;  ! -> RG311?
        IndRMove v_mecunit, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== indspeed
! rule: arguments of IndSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR mecunit v_mecunit;
    PROC main()
        r := IndSpeed(v_mecunit, 1);
        r := IndSpeed(v_mecunit, 1 \InSpeed);
        r := IndSpeed(v_mecunit, 1 \ZeroSpeed);
        r := IndSpeed();  ! -> RG311
        r := IndSpeed(v_mecunit, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== loadid
! rule: arguments of LoadId
! source: [manual] 3HAC050917
MODULE Demo
    VAR loadidnum v_loadidnum;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PERS loaddata p_loaddata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        LoadId v_paridnum, v_loadidnum, p_tooldata;
        LoadId v_paridnum, v_loadidnum, p_tooldata \PayLoad:=p_loaddata \WObj:=p_wobjdata \ConfAngle:=1 \SlowTest \Accuracy:=v_num;
        LoadId;  ! -> RG311?
        LoadId v_paridnum, v_loadidnum, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movecao
! rule: arguments of MoveCAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalao v_signalao;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveCAO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1;
        MoveCAO v_robtarget, v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalao, 1;
        MoveCAO;  ! -> RG311?
        MoveCAO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movecgo
! rule: arguments of MoveCGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalgo v_signalgo;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveCGO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo;
        MoveCGO v_robtarget, v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalgo;
        MoveCGO;  ! -> RG311?
        MoveCGO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movejao
! rule: arguments of MoveJAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalao v_signalao;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveJAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1;
        MoveJAO v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalao, 1;
        MoveJAO;  ! -> RG311?
        MoveJAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movejgo
! rule: arguments of MoveJGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalgo v_signalgo;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveJGO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo;
        MoveJGO v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalgo \Value:=1;
        MoveJGO;  ! -> RG311?
        MoveJGO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movelao
! rule: arguments of MoveLAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalao v_signalao;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveLAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1;
        MoveLAO v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalao, 1;
        MoveLAO;  ! -> RG311?
        MoveLAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== movelgo
! rule: arguments of MoveLGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalgo v_signalgo;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveLGO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo;
        MoveLGO v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalgo \Value:=1;
        MoveLGO;  ! -> RG311?
        MoveLGO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== mtoolrotcalib
! rule: arguments of MToolRotCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    PROC main()
        MToolRotCalib v_jointtarget, v_jointtarget, p_tooldata;
        MToolRotCalib v_jointtarget, v_jointtarget \XPos:=v_jointtarget, p_tooldata;
        MToolRotCalib;  ! -> RG311?
        MToolRotCalib v_jointtarget, v_jointtarget, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== mtooltcpcalib
! rule: arguments of MToolTCPCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    VAR num v_num;
    PERS tooldata p_tooldata;
    PROC main()
        MToolTCPCalib v_jointtarget, v_jointtarget, v_jointtarget, v_jointtarget, p_tooldata, v_num, v_num;
        MToolTCPCalib;  ! -> RG311?
        MToolTCPCalib v_jointtarget, v_jointtarget, v_jointtarget, v_jointtarget, p_tooldata, v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== procerrrecovery
! rule: arguments of ProcerrRecovery
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        ProcerrRecovery;
        ProcerrRecovery \SyncOrgMoveInst \ProcSignal:=v_signaldo;
        ProcerrRecovery \SyncLastMoveInst \ProcSignal:=v_signaldo;
        ProcerrRecovery \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readblock
! rule: arguments of ReadBlock
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ReadBlock "x", 1, "x";
        ReadBlock "x", 1, "x" \TaskName:="x";
        ReadBlock;  ! -> RG311?
        ReadBlock "x", 1, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== readvar
! rule: arguments of ReadVar
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r;
    PROC main()
        r := ReadVar("x", 1);
        r := ReadVar("x", 1 \TaskName:="x");
        r := ReadVar();  ! -> RG311
        r := ReadVar("x", 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== removeallcyclicbool
! rule: arguments of RemoveAllCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveAllCyclicBool;
        RemoveAllCyclicBool \AllTasks;
        RemoveAllCyclicBool \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setleadthrough
! rule: arguments of SetLeadThrough
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SetLeadThrough;
        SetLeadThrough \On \NoStopMove \NoClearPath;
        SetLeadThrough \Off \NoStartMove \NoClearPath;
        SetLeadThrough \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== setupcyclicbool
! rule: arguments of SetupCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PROC main()
        SetupCyclicBool p_bool, TRUE;
        SetupCyclicBool p_bool, TRUE \Signal:=v_signaldo;
        SetupCyclicBool;  ! -> RG311?
        SetupCyclicBool p_bool, TRUE \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== siclose
! rule: arguments of SiClose
! source: [manual] 3HAC050917
MODULE Demo
    PERS sensor p_sensor;
    PROC main()
        SiClose p_sensor;
        SiClose;  ! -> RG311?
        SiClose p_sensor \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== siconnect
! rule: arguments of SiConnect
! source: [manual] 3HAC050917
MODULE Demo
    PERS sensor p_sensor;
    PROC main()
        SiConnect p_sensor;
        SiConnect p_sensor \NoStop;
        SiConnect;  ! -> RG311?
        SiConnect p_sensor \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== sigetcyclic
! rule: arguments of SiGetCyclic
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PERS sensor p_sensor;
    PROC main()
        SiGetCyclic p_sensor, p_num, 1;
        SiGetCyclic;  ! -> RG311?
        SiGetCyclic p_sensor, p_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== sisetcyclic
! rule: arguments of SiSetCyclic
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PERS sensor p_sensor;
    PROC main()
        SiSetCyclic p_sensor, p_num, 1;
        SiSetCyclic;  ! -> RG311?
        SiSetCyclic p_sensor, p_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stoolrotcalib
! rule: arguments of SToolRotCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PROC main()
        SToolRotCalib v_robtarget, v_robtarget, v_robtarget, p_tooldata;
        SToolRotCalib;  ! -> RG311?
        SToolRotCalib v_robtarget, v_robtarget, v_robtarget, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== stooltcpcalib
! rule: arguments of SToolTCPCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PROC main()
        SToolTCPCalib v_robtarget, v_robtarget, v_robtarget, v_robtarget, p_tooldata, v_num, v_num;
        SToolTCPCalib;  ! -> RG311?
        SToolTCPCalib v_robtarget, v_robtarget, v_robtarget, v_robtarget, p_tooldata, v_num, v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggdatacopy
! rule: arguments of TriggDataCopy
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    PROC main()
        TriggDataCopy v_triggdata, v_triggdata;
        TriggDataCopy;  ! -> RG311?
        TriggDataCopy v_triggdata, v_triggdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggdatareset
! rule: arguments of TriggDataReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    PROC main()
        TriggDataReset v_triggdata;
        TriggDataReset;  ! -> RG311?
        TriggDataReset v_triggdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggdatavalid
! rule: arguments of TriggDataValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR triggdata v_triggdata;
    PROC main()
        r := TriggDataValid(v_triggdata);
        r := TriggDataValid();  ! -> RG311
        r := TriggDataValid(v_triggdata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggrampao
! rule: arguments of TriggRampAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR triggdata v_triggdata;
    PERS bool p_bool;
    PERS num p_num;
    PROC main()
        TriggRampAO v_triggdata, 1, 1, v_signalao, 1, 1;
        TriggRampAO v_triggdata, 1 \Start, 1, v_signalao, 1, 1 \Time \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggRampAO v_triggdata, 1 \Next, 1, v_signalao, 1, 1 \Time \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggRampAO;  ! -> RG311?
        TriggRampAO v_triggdata, 1, 1, v_signalao, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== triggspeed
! rule: arguments of TriggSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR signaldo v_signaldo;
    VAR triggdata v_triggdata;
    PERS bool p_bool;
    PERS num p_num;
    PROC main()
        TriggSpeed v_triggdata, 1, 1, v_signalao, 1;
        TriggSpeed v_triggdata, 1 \Start, 1, v_signalao, 1 \DipLag:=1 \ErrDO:=v_signaldo \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggSpeed;  ! -> RG311?
        TriggSpeed v_triggdata, 1, 1, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitsensor
! rule: arguments of WaitSensor
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR mecunit v_mecunit;
    PROC main()
        WaitSensor v_mecunit;
        WaitSensor v_mecunit \RelDist:=1 \PredTime:=1 \MaxTime:=1 \TimeFlag:=v_bool;
        WaitSensor;  ! -> RG311?
        WaitSensor v_mecunit \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== waitwobj
! rule: arguments of WaitWObj
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    PERS wobjdata p_wobjdata;
    PROC main()
        WaitWObj p_wobjdata;
        WaitWObj p_wobjdata \RelDist:=1 \MaxTime:=1 \TimeFlag:=v_bool;
        WaitWObj;  ! -> RG311?
        WaitWObj p_wobjdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writeblock
! rule: arguments of WriteBlock
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WriteBlock "x", 1, "x";
        WriteBlock "x", 1, "x" \TaskName:="x";
        WriteBlock;  ! -> RG311?
        WriteBlock "x", 1, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== writevar
! rule: arguments of WriteVar
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WriteVar "x", 1, 1;
        WriteVar "x", 1, 1 \TaskName:="x";
        WriteVar;  ! -> RG311?
        WriteVar "x", 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
