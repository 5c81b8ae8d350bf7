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
