! rule: arguments of ISignalGI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR intnum v_intnum;
    PROC main()
        ISignalGI v_signalgi, v_intnum;
        ISignalGI \Single, v_signalgi, v_intnum;
        ISignalGI \SingleSafe, v_signalgi, v_intnum;
        ISignalGI v_signalgi;  ! -> RG311
        ISignalGI v_signalgi, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
