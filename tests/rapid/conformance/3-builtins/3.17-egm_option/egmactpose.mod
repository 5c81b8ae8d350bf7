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
