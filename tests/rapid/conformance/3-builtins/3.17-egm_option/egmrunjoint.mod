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
