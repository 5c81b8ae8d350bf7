! rule: arguments of TriggRampAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR triggdata v_triggdata;
    PERS bool p_bool;
    PERS num p_num;
    PROC main()
        TriggRampAO v_triggdata, 1, 1, v_signalao, 1, 1;
        TriggRampAO v_triggdata, 1 \Start, 1, v_signalao, 1, 1 \Time \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggRampAO v_triggdata, 1 \Next, 1, v_signalao, 1, 1 \Time \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggRampAO;  ! -> RG311?
        TriggRampAO v_triggdata, 1, 1, v_signalao, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
