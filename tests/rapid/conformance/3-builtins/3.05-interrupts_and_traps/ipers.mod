! rule: arguments of IPers
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    VAR intnum v_intnum;
    PROC main()
        IPers p_num, v_intnum;
        IPers \Single, p_num, v_intnum;
        IPers \SingleSafe, p_num, v_intnum;
        IPers p_num;  ! -> RG311
        IPers p_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
