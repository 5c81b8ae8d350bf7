!=== acteventbuffer
! rule: arguments of ActEventBuffer
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ActEventBuffer;
        ActEventBuffer 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== capc
! rule: arguments of CapC
! source: [manual] 3HAC050917
MODULE Demo
    PERS capdata p_capdata;
    PERS captrackdata p_captrackdata;
    PERS capweavedata p_capweavedata;
    PERS loaddata p_loaddata;
    PERS tooldata p_tooldata;
    PERS weavestartdata p_weavestartdata;
    PERS wobjdata p_wobjdata;
    VAR identno v_identno;
    VAR num v_num;
    VAR robtarget v_robtarget;
    VAR speeddata v_speeddata;
    VAR stoppointdata v_stoppointdata;
    VAR triggdata v_triggdata;
    VAR zonedata v_zonedata;
    PROC main()
        CapC v_robtarget, v_robtarget, v_speeddata, p_capdata, p_weavestartdata, p_capweavedata, v_zonedata, p_tooldata;
        CapC v_robtarget, v_robtarget \Id:=v_identno, v_speeddata, p_capdata \Movestart_timer:=v_num, p_weavestartdata, p_capweavedata, v_zonedata \Inpos:=v_stoppointdata, p_tooldata \WObj:=p_wobjdata \Track:=p_captrackdata \Time:=v_num \T1:=v_triggdata \T2:=v_triggdata \T3:=v_triggdata \T4:=v_triggdata \T5:=v_triggdata \T6:=v_triggdata \T7:=v_triggdata \T8:=v_triggdata \TLoad:=p_loaddata;
        CapC;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== capcondsetdo
! rule: arguments of CapCondSetDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR dionum v_dionum;
    VAR signaldo v_signaldo;
    PROC main()
        CapCondSetDO v_signaldo, v_dionum;
        CapCondSetDO;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== capequidist
! rule: arguments of CapEquiDist
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        CapEquiDist;
        CapEquiDist \Distance:=v_num \Reset;
        CapEquiDist 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== capgetfailsigs
! rule: arguments of CapGetFailSigs
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := CapGetFailSigs(v_string);
        result := CapGetFailSigs();  ! -> RG311
    ENDPROC
ENDMODULE
!=== capl
! rule: arguments of CapL
! source: [manual] 3HAC050917
MODULE Demo
    PERS capdata p_capdata;
    PERS captrackdata p_captrackdata;
    PERS capweavedata p_capweavedata;
    PERS loaddata p_loaddata;
    PERS tooldata p_tooldata;
    PERS weavestartdata p_weavestartdata;
    PERS wobjdata p_wobjdata;
    VAR identno v_identno;
    VAR num v_num;
    VAR robtarget v_robtarget;
    VAR speeddata v_speeddata;
    VAR stoppointdata v_stoppointdata;
    VAR triggdata v_triggdata;
    VAR zonedata v_zonedata;
    PROC main()
        CapL v_robtarget, v_speeddata, p_capdata, p_weavestartdata, p_capweavedata, v_zonedata, p_tooldata;
        CapL v_robtarget \Id:=v_identno, v_speeddata, p_capdata \Movestart_timer:=v_num, p_weavestartdata, p_capweavedata, v_zonedata \Inpos:=v_stoppointdata, p_tooldata \WObj:=p_wobjdata \Track:=p_captrackdata \Time:=v_num \T1:=v_triggdata \T2:=v_triggdata \T3:=v_triggdata \T4:=v_triggdata \T5:=v_triggdata \T6:=v_triggdata \T7:=v_triggdata \T8:=v_triggdata \TLoad:=p_loaddata;
        CapL;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== capnoprocess
! rule: arguments of CapNoProcess
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        CapNoProcess v_num;
        CapNoProcess;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== caprefresh
! rule: arguments of CapRefresh
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR num v_num;
    PROC main()
        CapRefresh;
        CapRefresh \MainSpeed \MainWeave \Startweave:=v_bool \RestartDist:=v_num;
        CapRefresh 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== deacteventbuffer
! rule: arguments of DeactEventBuffer
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        DeactEventBuffer;
        DeactEventBuffer 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== egmsetupgi
! rule: arguments of EGMSetupGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR mecunit v_mecunit;
    VAR signalgi v_signalgi;
    VAR string v_string;
    PROC main()
        EGMSetupGI v_mecunit, v_egmident, v_string;
        EGMSetupGI v_mecunit, v_egmident, v_string \Joint \APTR \giR1x:=v_signalgi \giR2y:=v_signalgi \giR3z:=v_signalgi \giR4rx:=v_signalgi \giR5ry:=v_signalgi \giR6rz:=v_signalgi \giE1:=v_signalgi \giE2:=v_signalgi \giE3:=v_signalgi \giE4:=v_signalgi \giE5:=v_signalgi \giE6:=v_signalgi;
        EGMSetupGI;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== filetimednum
! rule: arguments of FileTimeDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR string v_string;
    VAR stringdig v_stringdig;
    PROC main()
        result := FileTimeDnum(v_string);
        result := FileTimeDnum(v_string \ModifyTime \StrDig:=v_stringdig);
        result := FileTimeDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== fitcircle
! rule: arguments of FitCircle
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR pos v_pos;
    VAR pos v_pos_2{2};
    PROC main()
        FitCircle v_pos_2, v_pos, v_num, v_pos;
        FitCircle v_pos_2 \NumPoints:=v_num, v_pos, v_num, v_pos \RMS:=v_num \MaxErr:=v_num \IndexWorst:=v_num;
        FitCircle;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== fricidevaluate
! rule: arguments of FricIdEvaluate
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num_2{2};
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR speeddata v_speeddata;
    PROC main()
        FricIdEvaluate p_num_2;
        FricIdEvaluate p_num_2 \MechUnit:=v_mecunit \BwdSpeed:=v_speeddata \NoPrint \FricLevelMax:=v_num \FricLevelMin:=v_num \OptTolerance:=v_num;
        FricIdEvaluate;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== fricidinit
! rule: arguments of FricIdInit
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        FricIdInit;
        FricIdInit 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== fricidsetfriclevels
! rule: arguments of FricIdSetFricLevels
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num_2{2};
    PROC main()
        FricIdSetFricLevels v_num_2;
        FricIdSetFricLevels v_num_2 \MechUnit:=v_mecunit;
        FricIdSetFricLevels;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== getaxisdistance
! rule: arguments of GetAxisDistance
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        result := GetAxisDistance(v_mecunit, v_num);
        result := GetAxisDistance();  ! -> RG311
    ENDPROC
ENDMODULE
!=== getaxismovetime
! rule: arguments of GetAxisMoveTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        result := GetAxisMoveTime(v_mecunit, v_num);
        result := GetAxisMoveTime();  ! -> RG311
    ENDPROC
ENDMODULE
!=== getmodalpayloadmode
! rule: arguments of GetModalPayLoadMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := GetModalPayLoadMode();
        result := GetModalPayLoadMode(1);  ! -> RG311
    ENDPROC
ENDMODULE
!=== getnextcyclicbool
! rule: arguments of GetNextCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := GetNextCyclicBool(v_num, v_string);
        result := GetNextCyclicBool();  ! -> RG311
    ENDPROC
ENDMODULE
!=== getnumberofcyclicbool
! rule: arguments of GetNumberOfCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := GetNumberOfCyclicBool();
        result := GetNumberOfCyclicBool(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== getsignalorigin
! rule: arguments of GetSignalOrigin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signalorigin result;
    VAR string v_string;
    PROC main()
        result := GetSignalOrigin(v_num, v_string);
        result := GetSignalOrigin();  ! -> RG311
    ENDPROC
ENDMODULE
!=== gettspstatus
! rule: arguments of GetTSPStatus
! source: [manual] 3HAC050917
MODULE Demo
    VAR taskid v_taskid;
    VAR tsp_status result;
    PROC main()
        result := GetTSPStatus(v_taskid);
        result := GetTSPStatus();  ! -> RG311
    ENDPROC
ENDMODULE
!=== hollowwristreset
! rule: arguments of HollowWristReset
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        HollowWristReset;
        HollowWristReset 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== icap
! rule: arguments of ICap
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    VAR num v_num;
    PROC main()
        ICap v_intnum, v_num;
        ICap;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== initsuperv
! rule: arguments of InitSuperv
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        InitSuperv;
        InitSuperv 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== iobusstart
! rule: arguments of IOBusStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        IOBusStart v_string;
        IOBusStart;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== iobusstate
! rule: arguments of IOBusState
! source: [manual] 3HAC050917
MODULE Demo
    VAR busstate v_busstate;
    VAR string v_string;
    PROC main()
        IOBusState v_string, v_busstate;
        IOBusState v_string, v_busstate \Phys;
        IOBusState;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== isbrakecheckactive
! rule: arguments of IsBrakeCheckActive
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := IsBrakeCheckActive();
        result := IsBrakeCheckActive(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== iscyclicbool
! rule: arguments of IsCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR bool result;
    VAR taskid v_taskid;
    PROC main()
        result := IsCyclicBool(p_bool);
        result := IsCyclicBool(p_bool \TaskRef:=v_taskid);
        result := IsCyclicBool();  ! -> RG311
    ENDPROC
ENDMODULE
!=== manloadidproc
! rule: arguments of ManLoadIdProc
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    VAR loaddata v_loaddata;
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PROC main()
        ManLoadIdProc;
        ManLoadIdProc \ParIdType:=v_paridnum \MechUnit:=v_mecunit \AxisNumber:=v_num \PayLoad:=v_loaddata \ConfigAngle:=v_num \DeactAll \DefinedFlag:=v_bool \DoExit:=v_bool;
        ManLoadIdProc 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== matrixsolve
! rule: arguments of MatrixSolve
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum_2x2{2,2};
    VAR dnum v_dnum_2{2};
    VAR num v_num;
    PROC main()
        MatrixSolve v_dnum_2x2, v_dnum_2, v_dnum_2;
        MatrixSolve v_dnum_2x2 \A_m:=v_num \A_n:=v_num, v_dnum_2, v_dnum_2;
        MatrixSolve;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== matrixsolveqr
! rule: arguments of MatrixSolveQR
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum_2x2{2,2};
    VAR num v_num;
    PROC main()
        MatrixSolveQR v_dnum_2x2, v_dnum_2x2, v_dnum_2x2;
        MatrixSolveQR v_dnum_2x2 \A_m:=v_num \A_n:=v_num, v_dnum_2x2, v_dnum_2x2;
        MatrixSolveQR;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== matrixsvd
! rule: arguments of MatrixSVD
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum_2x2{2,2};
    VAR dnum v_dnum_2{2};
    VAR num v_num;
    PROC main()
        MatrixSVD v_dnum_2x2, v_dnum_2x2, v_dnum_2, v_dnum_2x2;
        MatrixSVD v_dnum_2x2 \A_m:=v_num \A_n:=v_num, v_dnum_2x2, v_dnum_2, v_dnum_2x2 \Econ;
        MatrixSVD;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== modtimednum
! rule: arguments of ModTimeDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum result;
    VAR string v_string;
    VAR stringdig v_stringdig;
    PROC main()
        result := ModTimeDnum(v_string);
        result := ModTimeDnum(v_string \StrDig:=v_stringdig);
        result := ModTimeDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== motionprocessmodeset
! rule: arguments of MotionProcessModeSet
! source: [manual] 3HAC050917
MODULE Demo
    VAR motionprocessmode v_motionprocessmode;
    PROC main()
        MotionProcessModeSet v_motionprocessmode;
        MotionProcessModeSet;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== paridposvalid
! rule: arguments of ParIdPosValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR bool v_bool_2{2};
    VAR jointtarget v_jointtarget;
    VAR num v_num;
    VAR paridnum v_paridnum;
    PROC main()
        result := ParIdPosValid(v_paridnum, v_jointtarget, v_bool_2);
        result := ParIdPosValid(v_paridnum, v_jointtarget, v_bool_2 \ConfAngle:=v_num);
        result := ParIdPosValid();  ! -> RG311
    ENDPROC
ENDMODULE
!=== paridrobvalid
! rule: arguments of ParIdRobValid
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR paridnum v_paridnum;
    VAR paridvalidnum result;
    PROC main()
        result := ParIdRobValid(v_paridnum);
        result := ParIdRobValid(v_paridnum \MechUnit:=v_mecunit \AxisNo:=v_num);
        result := ParIdRobValid();  ! -> RG311
    ENDPROC
ENDMODULE
!=== pfrestart
! rule: arguments of PFRestart
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := PFRestart();
        result := PFRestart(\Base);
        result := PFRestart(1);  ! -> RG311
    ENDPROC
ENDMODULE
!=== ppmovedinmanmode
! rule: arguments of PPMovedInManMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    PROC main()
        result := PPMovedInManMode();
        result := PPMovedInManMode(1);  ! -> RG311
    ENDPROC
ENDMODULE
!=== progmemfree
! rule: arguments of ProgMemFree
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := ProgMemFree();
        result := ProgMemFree(1);  ! -> RG311
    ENDPROC
ENDMODULE
!=== prxactivandstorerecord
! rule: arguments of PrxActivAndStoreRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        PrxActivAndStoreRecord v_mecunit, v_num, v_string;
        PrxActivAndStoreRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxactivrecord
! rule: arguments of PrxActivRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxActivRecord v_mecunit, v_num;
        PrxActivRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxdbgstorerecord
! rule: arguments of PrxDbgStoreRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR string v_string;
    PROC main()
        PrxDbgStoreRecord v_mecunit, v_string;
        PrxDbgStoreRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxdeactrecord
! rule: arguments of PrxDeactRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxDeactRecord v_mecunit;
        PrxDeactRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxgetmaxrecordpos
! rule: arguments of PrxGetMaxRecordpos
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num result;
    PROC main()
        result := PrxGetMaxRecordpos(v_mecunit);
        result := PrxGetMaxRecordpos();  ! -> RG311
    ENDPROC
ENDMODULE
!=== prxresetpos
! rule: arguments of PrxResetPos
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxResetPos v_mecunit;
        PrxResetPos;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxresetrecords
! rule: arguments of PrxResetRecords
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxResetRecords v_mecunit;
        PrxResetRecords;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxsetposoffset
! rule: arguments of PrxSetPosOffset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetPosOffset v_mecunit, v_num;
        PrxSetPosOffset;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxsetrecordsampletime
! rule: arguments of PrxSetRecordSampleTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetRecordSampleTime v_mecunit, v_num;
        PrxSetRecordSampleTime;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxsetsyncalarm
! rule: arguments of PrxSetSyncalarm
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxSetSyncalarm v_mecunit;
        PrxSetSyncalarm v_mecunit \Time:=v_num;
        PrxSetSyncalarm;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxstartrecord
! rule: arguments of PrxStartRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        PrxStartRecord v_mecunit, v_num, v_num;
        PrxStartRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxstoprecord
! rule: arguments of PrxStopRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        PrxStopRecord v_mecunit;
        PrxStopRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxstorerecord
! rule: arguments of PrxStoreRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        PrxStoreRecord v_mecunit, v_num, v_string;
        PrxStoreRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== prxusefilerecord
! rule: arguments of PrxUseFileRecord
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        PrxUseFileRecord v_mecunit, v_num, v_string;
        PrxUseFileRecord;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== removesuperv
! rule: arguments of RemoveSuperv
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    PROC main()
        RemoveSuperv v_signaldi, v_num, v_num;
        RemoveSuperv;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== resetaxisdistance
! rule: arguments of ResetAxisDistance
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        ResetAxisDistance v_mecunit, v_num;
        ResetAxisDistance;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== resetaxismovetime
! rule: arguments of ResetAxisMoveTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        ResetAxisMoveTime v_mecunit, v_num;
        ResetAxisMoveTime;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== resetppmoved
! rule: arguments of ResetPPMoved
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ResetPPMoved;
        ResetPPMoved 1;  ! -> RG311
    ENDPROC
ENDMODULE
!=== safetycontrollergetchecksum
! rule: arguments of SafetyControllerGetChecksum
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetChecksum();
        result := SafetyControllerGetChecksum(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== safetycontrollergetopmodepincode
! rule: arguments of SafetyControllerGetOpModePinCode
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetOpModePinCode();
        result := SafetyControllerGetOpModePinCode(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== safetycontrollergetswversion
! rule: arguments of SafetyControllerGetSWVersion
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetSWVersion();
        result := SafetyControllerGetSWVersion(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== safetycontrollergetuserchecksum
! rule: arguments of SafetyControllerGetUserChecksum
! source: [manual] 3HAC050917
MODULE Demo
    VAR string result;
    PROC main()
        result := SafetyControllerGetUserChecksum();
        result := SafetyControllerGetUserChecksum(1);  ! -> RG311?
    ENDPROC
ENDMODULE
!=== safetycontrollersyncrequest
! rule: arguments of SafetyControllerSyncRequest
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SafetyControllerSyncRequest;
        SafetyControllerSyncRequest 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== setupsuperv
! rule: arguments of SetupSuperv
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PROC main()
        SetupSuperv v_signaldi, v_num, v_num;
        SetupSuperv v_signaldi, v_num, v_num \ErrIndSig:=v_signaldo;
        SetupSuperv;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== spystart
! rule: arguments of SpyStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        SpyStart v_string;
        SpyStart;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== spystop
! rule: arguments of SpyStop
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SpyStop;
        SpyStop 1;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== startmoveretry
! rule: arguments of StartMoveRetry
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        StartMoveRetry;
        StartMoveRetry 1;  ! -> RG311
    ENDPROC
ENDMODULE
!=== stcalcforce
! rule: arguments of STCalcForce
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STCalcForce(v_string, v_num);
        result := STCalcForce();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stcalctorque
! rule: arguments of STCalcTorque
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STCalcTorque(v_string, v_num);
        result := STCalcTorque();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stcalib
! rule: arguments of STCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STCalib v_string;
        STCalib v_string \ToolChg \RetTipWear:=v_num \RetPosAdj:=v_num \PrePos:=v_num \Conc;
        STCalib;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== stclose
! rule: arguments of STClose
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STClose v_string, v_num, v_num;
        STClose v_string, v_num, v_num \RetThickness:=v_num \Conc;
        STClose;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== stindgun
! rule: arguments of STIndGun
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STIndGun v_string, v_num;
        STIndGun;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== stindgunreset
! rule: arguments of STIndGunReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        STIndGunReset v_string;
        STIndGunReset;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== stiscalib
! rule: arguments of STIsCalib
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := STIsCalib(v_string);
        result := STIsCalib(v_string \sguninit);
        result := STIsCalib();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stisclosed
! rule: arguments of STIsClosed
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STIsClosed(v_string);
        result := STIsClosed(v_string \RetThickness:=v_num);
        result := STIsClosed();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stisindgun
! rule: arguments of STIsIndGun
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := STIsIndGun(v_string);
        result := STIsIndGun();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stisopen
! rule: arguments of STIsOpen
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STIsOpen(v_string);
        result := STIsOpen(v_string \RetTipWear:=v_num \RetPosAdj:=v_num);
        result := STIsOpen();  ! -> RG311
    ENDPROC
ENDMODULE
!=== stopen
! rule: arguments of STOpen
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        STOpen v_string;
        STOpen v_string \WaitZeroSpeed \Conc;
        STOpen;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== sttune
! rule: arguments of STTune
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR tunegtype v_tunegtype;
    PROC main()
        STTune v_mecunit, v_num, v_tunegtype;
        STTune;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== sttunereset
! rule: arguments of STTuneReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        STTuneReset v_mecunit;
        STTuneReset;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== supsyncsensoroff
! rule: arguments of SupSyncSensorOff
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    PROC main()
        SupSyncSensorOff v_mecunit;
        SupSyncSensorOff;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== supsyncsensoron
! rule: arguments of SupSyncSensorOn
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    PROC main()
        SupSyncSensorOn v_mecunit, v_num, v_num, v_num;
        SupSyncSensorOn v_mecunit, v_num, v_num, v_num \SafetyDelay:=v_num;
        SupSyncSensorOn;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== uidnumtune
! rule: arguments of UIDnumTune
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR dnum result;
    VAR dnum v_dnum;
    VAR errnum v_errnum;
    VAR icondata v_icondata;
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    VAR string v_string;
    PROC main()
        result := UIDnumTune(v_dnum, v_dnum);
        result := UIDnumTune(\Header:=v_string \Message:=v_string \Wrap \Icon:=v_icondata, v_dnum, v_dnum \MinValue:=v_dnum \MaxValue:=v_dnum \MaxTime:=v_num \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        result := UIDnumTune();  ! -> RG311
    ENDPROC
ENDMODULE
!=== uimsgwriteabort
! rule: arguments of UIMsgWriteAbort
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        UIMsgWriteAbort;
        UIMsgWriteAbort 1;  ! -> RG311
    ENDPROC
ENDMODULE
