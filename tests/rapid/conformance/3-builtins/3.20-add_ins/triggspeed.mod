! rule: arguments of TriggSpeed
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR signaldo v_signaldo;
    VAR triggdata v_triggdata;
    PERS bool p_bool;
    PERS num p_num;
    PROC main()
        TriggSpeed v_triggdata, 1, 1, v_signalao, 1;
        TriggSpeed v_triggdata, 1 \Start, 1, v_signalao, 1 \DipLag:=1 \ErrDO:=v_signaldo \Inhib:=p_bool \InhibSetValue:=p_num;
        TriggSpeed;  ! -> RG311?
        TriggSpeed v_triggdata, 1, 1, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
