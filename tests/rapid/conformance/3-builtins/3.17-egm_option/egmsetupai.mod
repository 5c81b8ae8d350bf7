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
