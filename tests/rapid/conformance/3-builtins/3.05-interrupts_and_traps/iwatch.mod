! rule: arguments of IWatch
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IWatch v_intnum;
        IWatch;  ! -> RG311?
        IWatch v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
