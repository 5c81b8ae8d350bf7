! rule: arguments of ISignalAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao s;
    VAR intnum i;
    PROC main()
        ISignalAO s, AIO_BETWEEN, 1, 2, 0, i;
        ISignalAO \Single, s, AIO_ALWAYS, 1, 2, 0 \DPos, i;
        ISignalAO \SingleSafe, s, AIO_ALWAYS, 1, 2, 0 \DNeg, i;
        ISignalAO s, AIO_ALWAYS, 1, 2, 0;  ! -> RG311
        ISignalAO s, AIO_ALWAYS, 1, 2, 0 \DPos \DNeg, i;  ! -> RG313
    ENDPROC
ENDMODULE
