! rule: arguments of ISignalDI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR intnum v_intnum;
    PROC main()
        ISignalDI v_signaldi, 1, v_intnum;
        ISignalDI \Single, v_signaldi, 1, v_intnum;
        ISignalDI \SingleSafe, v_signaldi, 1, v_intnum;
        ISignalDI v_signaldi, 1;  ! -> RG311
        ISignalDI v_signaldi, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
