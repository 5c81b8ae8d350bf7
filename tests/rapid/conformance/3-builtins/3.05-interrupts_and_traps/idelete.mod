! rule: arguments of IDelete
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        IDelete v_intnum;
        IDelete;  ! -> RG311?
        IDelete v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
