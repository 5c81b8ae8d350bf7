! rule: arguments of ISignalAI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalai s;
    VAR intnum i;
    PROC main()
        ISignalAI s, AIO_BETWEEN, 1, 2, 0, i;
        ISignalAI \Single, s, AIO_ALWAYS, 1, 2, 0 \DPos, i;
        ISignalAI \SingleSafe, s, AIO_ALWAYS, 1, 2, 0 \DNeg, i;
        ISignalAI s, AIO_ALWAYS, 1, 2, 0;  ! -> RG311
        ISignalAI s, AIO_ALWAYS, 1, 2, 0 \DPos \DNeg, i;  ! -> RG313
    ENDPROC
ENDMODULE
