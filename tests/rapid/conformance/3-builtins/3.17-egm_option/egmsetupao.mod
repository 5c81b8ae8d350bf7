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
