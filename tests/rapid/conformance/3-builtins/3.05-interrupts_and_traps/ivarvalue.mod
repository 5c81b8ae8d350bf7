! rule: arguments of IVarValue
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    VAR intnum v_intnum;
    PROC main()
        IVarValue "x", 1, p_num, v_intnum;
        IVarValue "x", 1, p_num, v_intnum \Unit:=1 \DeadBand:=1 \ReportAtTool \SpeedAdapt:=1 \APTR;
        IVarValue "x", 1, p_num;  ! -> RG311
        IVarValue "x", 1, p_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
