! rule: arguments of TriggEquip
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PERS num p_num;
    VAR signalgo v_signalgo;
    VAR signalao v_signalao;
    PROC main()
        TriggEquip v_triggdata, 1, 1, 1;
        TriggEquip v_triggdata, 1 \Start, 1 \DOp:=v_signaldo, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Next, 1 \GOp:=v_signalgo, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Start, 1 \AOp:=v_signalao, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1 \Next, 1 \ProcID:=1, 1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggEquip v_triggdata, 1, 1;  ! -> RG311
        TriggEquip v_triggdata, 1, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
