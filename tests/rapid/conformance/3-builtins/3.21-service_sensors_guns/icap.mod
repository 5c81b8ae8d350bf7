! rule: arguments of ICap
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    VAR num v_num;
    PROC main()
        ICap v_intnum, v_num;
        ICap;  ! -> RG311?
    ENDPROC
ENDMODULE
