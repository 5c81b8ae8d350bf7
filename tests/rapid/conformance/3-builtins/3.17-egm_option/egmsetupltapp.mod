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
