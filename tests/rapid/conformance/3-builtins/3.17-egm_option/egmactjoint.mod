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
