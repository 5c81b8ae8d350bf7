! rule: arguments of ISignalDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    VAR intnum v_intnum;
    PROC main()
        ISignalDO v_signaldo, 1, v_intnum;
        ISignalDO \Single, v_signaldo, 1, v_intnum;
        ISignalDO \SingleSafe, v_signaldo, 1, v_intnum;
        ISignalDO v_signaldo, 1;  ! -> RG311
        ISignalDO v_signaldo, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
