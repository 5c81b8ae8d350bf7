! rule: arguments of ITimer
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        ITimer 1, v_intnum;
        ITimer \Single, 1, v_intnum;
        ITimer \SingleSafe, 1, v_intnum;
        ITimer 1;  ! -> RG311
        ITimer 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
