! rule: arguments of IPathPos
! source: [manual] 3HAC050917
MODULE Demo
    PERS robtarget p_robtarget;
    PERS pos p_pos;
    VAR intnum v_intnum;
    PROC main()
        IPathPos p_robtarget, p_pos, v_intnum;
        IPathPos p_robtarget, p_pos, v_intnum \EOffs \NoDispl;
        IPathPos p_robtarget, p_pos;  ! -> RG311
        IPathPos p_robtarget, p_pos, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
