! rule: arguments of ISignalGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR intnum v_intnum;
    PROC main()
        ISignalGO v_signalgo, v_intnum;
        ISignalGO \Single, v_signalgo, v_intnum;
        ISignalGO \SingleSafe, v_signalgo, v_intnum;
        ISignalGO v_signalgo;  ! -> RG311
        ISignalGO v_signalgo, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
