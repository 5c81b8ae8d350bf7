! rule: arguments of IRMQMessage
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR intnum v_intnum;
    PROC main()
        IRMQMessage v_num, v_intnum;
        IRMQMessage v_num;  ! -> RG311
        IRMQMessage v_num, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
