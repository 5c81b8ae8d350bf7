MODULE stop_owner
    ! source: no manual settles whose stop a StartMove of a background task takes back: a motion setting
    ! robot: irb120
    ! task: T_STOPS stops SEMISTATIC
    ! task: T_STARTS starts SEMISTATIC
    ! case: motion.stop_owner=kind
    ! do: start, run 1.5
    ! expect: stands
    ! do: run 20
    ! expect: goes on
    ! case: motion.stop_owner=task
    ! do: start, run 1.5
    ! expect: stands
    ! do: run 20
    PROC main()
        MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
        EXIT;
    ENDPROC
    PROC stops()
        VAR jointtarget here;
        WaitTime 0.5;
        StopMove;
        WaitTime 0.8;
        here := CJointT(\TaskName:="T_ROB1");
        IF here.robax.rax_1 > 0 AND here.robax.rax_1 < 60 TPWrite "stands";
        WaitTime 60;
    ENDPROC
    PROC starts()
        VAR jointtarget here;
        VAR jointtarget later;
        WaitTime 1.4;
        here := CJointT(\TaskName:="T_ROB1");
        WaitTime 0.6;
        IF IsStopMoveAct(\FromNonMoveTask) StartMove;
        WaitTime 10;
        later := CJointT(\TaskName:="T_ROB1");
        IF later.robax.rax_1 > here.robax.rax_1 + 57 TPWrite "goes on";
        WaitTime 60;
    ENDPROC
ENDMODULE
