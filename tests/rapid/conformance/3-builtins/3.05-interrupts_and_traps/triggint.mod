! rule: arguments of TriggInt
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR intnum v_intnum;
    PERS bool p_bool;
    PROC main()
        TriggInt v_triggdata, 1, v_intnum;
        TriggInt v_triggdata, 1 \Start, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1 \Next, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1 \Time, v_intnum \Inhib:=p_bool \Mode:=1;
        TriggInt v_triggdata, 1;  ! -> RG311
        TriggInt v_triggdata, 1, v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
