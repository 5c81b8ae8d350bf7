MODULE egm_not_awaited
    ! source: [manual] 3HAC073318: behind \NoWaitCond a lost partner is always fatal; event 41822
    ! robot: irb120
    ! expect: 2 after 4
    ! fault: 41822 16
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;

    PROC main()
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=5;
        EGMActJoint id \J1:=near;
        EGMRunJoint id, EGM_STOP_HOLD \NoWaitCond \J1;
        WaitTime 4;
        TPWrite ValToStr(EGMGetState(id)) + " after 4";
        EGMWaitCond id;
        TPWrite "never";
    ERROR
        TRYNEXT;
    ENDPROC
ENDMODULE
