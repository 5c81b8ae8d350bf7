!=== egmactjoint
! rule: arguments of EGMActJoint
! source: [manual] 3HAC050917; signals and data: 3HAC073318 §5 [manual], examples of ABB's engineers [code FLo-ABB]
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    VAR signaldo so;
    VAR signaldi si;
    VAR dnum d{2};
    PROC main()
        EGMActJoint e;
        EGMActJoint e \Tool:=t \WObj:=w \TLoad:=l \J1:=m \J2:=m \J3:=m \J4:=m \J5:=m \J6:=m \J7:=m \LpFilter:=1 \SampleRate:=4 \MaxPosDeviation:=1 \MaxSpeedDeviation:=1;
        EGMActJoint e \DOToSensor:=so \DataToSensor:=d \DIFromSensor:=si \DataFromSensor:=d;
        EGMActJoint;  ! -> RG311?
        EGMActJoint e \J8:=m;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmactmove
! rule: arguments of EGMActMove
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR pose v_pose;
    PROC main()
        EGMActMove v_egmident, v_pose;
        EGMActMove v_egmident, v_pose \SampleRate:=1;
        EGMActMove v_egmident;  ! -> RG311
        EGMActMove v_egmident, v_pose \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmactpose
! rule: arguments of EGMActPose
! source: [manual] 3HAC050917; signals and data: 3HAC073318 §5 [manual], examples of ABB's engineers [code FLo-ABB]
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    VAR signaldo so;
    VAR signaldi si;
    VAR dnum d{2};
    PROC main()
        EGMActPose e, f, EGM_FRAME_BASE, f, EGM_FRAME_BASE;
        EGMActPose e \Tool:=t \WObj:=w \TLoad:=l, f, EGM_FRAME_BASE, f, EGM_FRAME_BASE \x:=m \y:=m \z:=m \rx:=m \ry:=m \rz:=m \LpFilter:=1 \SampleRate:=4 \MaxPosDeviation:=1 \MaxSpeedDeviation:=1;
        EGMActPose e \DOToSensor:=so \DataToSensor:=d \DIFromSensor:=si \DataFromSensor:=d, f, EGM_FRAME_BASE, f, EGM_FRAME_BASE;
        EGMActPose e, f, EGM_FRAME_BASE, f;  ! -> RG311
    ENDPROC
ENDMODULE
!=== egmgetid
! rule: arguments of EGMGetId
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMGetId v_egmident;
        EGMGetId;  ! -> RG311?
        EGMGetId v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmgetstate
! rule: arguments of EGMGetState
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR egmstate r_egmstate;
    PROC main()
        r_egmstate := EGMGetState(v_egmident);
        r_egmstate := EGMGetState();  ! -> RG311
        r_egmstate := EGMGetState(v_egmident \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmmovel
! rule: arguments of EGMMoveL
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata;
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata \WObj:=p_wobjdata \TLoad:=p_loaddata \NoCorr;
        EGMMoveL v_egmident, v_robtarget, v100, z10;  ! -> RG311
        EGMMoveL v_egmident, v_robtarget, v100, z10, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmreset
! rule: arguments of EGMReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMReset v_egmident;
        EGMReset;  ! -> RG311?
        EGMReset v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmrunjoint
! rule: arguments of EGMRunJoint
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    PROC main()
        EGMRunJoint e, EGM_STOP_HOLD;
        EGMRunJoint e, EGM_STOP_RAMP_DOWN \NoWaitCond \J1 \J2 \J3 \J4 \J5 \J6 \J7 \CondTime:=1 \RampInTime:=1 \RampOutTime:=1 \PosCorrGain:=1;
        EGMRunJoint e;  ! -> RG311
    ENDPROC
ENDMODULE
!=== egmrunpose
! rule: arguments of EGMRunPose
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    VAR pose v_pose;
    PROC main()
        EGMRunPose v_egmident, 1;
        EGMRunPose v_egmident, 1 \NoWaitCond \x \y \z \rx \ry \rz \CondTime:=1 \RampInTime:=1 \RampOutTime:=1 \Offset:=v_pose \PosCorrGain:=1;
        EGMRunPose v_egmident;  ! -> RG311
        EGMRunPose v_egmident, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmsetupai
! rule: arguments of EGMSetupAI
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    VAR signalai s;
    PROC main()
        EGMSetupAI u, e, "c" \Joint \aiR1x:=s;
        EGMSetupAI u, e, "c" \Pose \APTR \aiR1x:=s \aiR2y:=s \aiR3z:=s \aiR4rx:=s \aiR5ry:=s \aiR6rz:=s \aiE1:=s \aiE2:=s \aiE3:=s \aiE4:=s \aiE5:=s \aiE6:=s;
        EGMSetupAI u, e, "c" \PathCorr \LATR;
        EGMSetupAI u, e;  ! -> RG311
        EGMSetupAI u, e, "c" \Joint \Pose;  ! -> RG313
    ENDPROC
ENDMODULE
!=== egmsetupao
! rule: arguments of EGMSetupAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    VAR signalao s;
    PROC main()
        EGMSetupAO u, e, "c" \Joint \aoR1x:=s;
        EGMSetupAO u, e, "c" \Pose \APTR \aoR1x:=s \aoR2y:=s \aoR3z:=s \aoR4rx:=s \aoR5ry:=s \aoR6rz:=s \aoE1:=s \aoE2:=s \aoE3:=s \aoE4:=s \aoE5:=s \aoE6:=s;
        EGMSetupAO u, e, "c" \PathCorr \LATR;
        EGMSetupAO u, e;  ! -> RG311
        EGMSetupAO u, e, "c" \Joint \Pose;  ! -> RG313
    ENDPROC
ENDMODULE
!=== egmsetupltapp
! rule: arguments of EGMSetupLTAPP
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident e;
    PERS tooldata t;
    PERS wobjdata w;
    PERS loaddata l;
    CONST egm_minmax m := [-1, 1];
    VAR pose f;
    VAR mecunit u;
    PROC main()
        EGMSetupLTAPP u, e, "c", "d", 1 \APTR;
        EGMSetupLTAPP u, e, "c", "d", 1 \LATR;
        EGMSetupLTAPP u, e, "c", "d";  ! -> RG311
    ENDPROC
ENDMODULE
!=== egmsetupuc
! rule: arguments of EGMSetupUC
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR egmident v_egmident;
    PROC main()
        EGMSetupUC v_mecunit, v_egmident, "x", "x";
        EGMSetupUC v_mecunit, v_egmident, "x", "x" \Joint \APTR \CommTimeout:=1;
        EGMSetupUC v_mecunit, v_egmident, "x", "x" \Pose \LATR \CommTimeout:=1;
        EGMSetupUC v_mecunit, v_egmident, "x", "x" \PathCorr \APTR \CommTimeout:=1;
        EGMSetupUC v_mecunit, v_egmident, "x";  ! -> RG311
        EGMSetupUC v_mecunit, v_egmident, "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmstop
! rule: arguments of EGMStop
! source: [manual] 3HAC050917
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStop v_egmident, 1;
        EGMStop v_egmident, 1 \RampOutTime:=1;
        EGMStop v_egmident;  ! -> RG311
        EGMStop v_egmident, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmstreamstart
! rule: arguments of EGMStreamStart
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStreamStart v_egmident;
        EGMStreamStart v_egmident \SampleRate:=1;
        EGMStreamStart;  ! -> RG311?
        EGMStreamStart v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== egmstreamstop
! rule: arguments of EGMStreamStop
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR egmident v_egmident;
    PROC main()
        EGMStreamStop v_egmident;
        EGMStreamStop;  ! -> RG311?
        EGMStreamStop v_egmident \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
