! rule: arguments of TriggCheckIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR num v_num;
    VAR intnum v_intnum;
    PERS bool p_bool;
    PROC main()
        TriggCheckIO v_triggdata, 1, v_num, 1, 1, v_intnum;
        TriggCheckIO v_triggdata, 1 \Start, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1 \Next, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1 \Time, v_num, 1, 1 \StopMove, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggCheckIO v_triggdata, 1, v_num, 1, 1;  ! -> RG311
        TriggCheckIO v_triggdata, 1, v_num, 1, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
