! rule: arguments of TriggIO
! source: [manual] 3HAC050917
MODULE Demo
    VAR triggdata v_triggdata;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    PERS num p_num;
    VAR signalgo v_signalgo;
    VAR signalao v_signalao;
    PROC main()
        TriggIO v_triggdata, 1, 1;
        TriggIO v_triggdata, 1 \Start \DOp:=v_signaldo, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Next \GOp:=v_signalgo, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Time \AOp:=v_signalao, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1 \Start \ProcID:=1, 1 \DODelay:=1 \Inhib:=p_bool \InhibSetValue:=p_num \Mode:=1;
        TriggIO v_triggdata, 1;  ! -> RG311
        TriggIO v_triggdata, 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
