MODULE egm_never
    ! source: a GoFa with RobotWare 7.21 stayed in EGMRunJoint for 2 min with 5 s told [code: abb-gofa]
    ! dialect: egm_patience=never
    ! robot: irb120
    ! expect: 30 and 30
    CONST egm_minmax near := [-0.5, 0.5];
    VAR egmident id;
    VAR intnum ends;
    VAR clock watch;
    VAR num first;

    PROC main()
        EGMGetId id;
        CONNECT ends WITH stops;
        first := Lasts();
        TPWrite ValToStr(first) + " and " + ValToStr(Lasts(\told:=5));
    ENDPROC

    FUNC num Lasts(\num told)
        IF Present(told) THEN
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=told;
        ELSE
            EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
        ENDIF
        EGMActJoint id \J1:=near;
        ITimer \Single, 30, ends;
        ClkReset watch;
        ClkStart watch;
        EGMRunJoint id, EGM_STOP_HOLD \J1;
        RETURN Round(ClkRead(watch));
    ERROR
        IF ERRNO = ERR_UDPUC_COMM RETURN Round(ClkRead(watch));
    ENDFUNC

    TRAP stops
        EGMStop id, EGM_STOP_HOLD;
    ENDTRAP
ENDMODULE
