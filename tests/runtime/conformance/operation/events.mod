MODULE events
    ! source: [code] CAB_EXEC_HOOKS; [DB] numbers of EventType and ExecLevel; [S4 overview 5-23] a wait begins anew
    ! hook: power_on POWER_ON T_ROB1
    ! hook: started START T_ROB1
    ! hook: stopped STOP T_ROB1
    ! hook: quick QSTOP T_ROB1
    ! hook: again RESTART T_ROB1
    ! hook: reset_all RESET T_ROB1
    ! case:
    ! do: start, run 0.5, stop, run 1
    ! expect: POWER_ON 12
    ! expect: START 22
    ! expect: main
    ! expect: STOP 32
    ! do: start, run 1.2
    ! expect: RESTART 52
    ! expect: end
    ! case:
    ! POWER_ON needs no start.
    ! do: run 1
    ! expect: POWER_ON 12
    ! state: ready
    ! do: start, run 0.1
    ! expect: START 22
    ! expect: main
    ! case: e_stop_routines=true
    ! An emergency stop is a quick stop [mem]; a second stop, when it stands already, is no event.
    ! do: start, run 0.5
    ! expect: POWER_ON 12
    ! expect: START 22
    ! expect: main
    ! do: e-stop, run 1
    ! expect: QSTOP 42
    ! do: stop, run 1
    ! case: e_stop_routines=false
    ! do: start, run 0.5
    ! expect: POWER_ON 12
    ! expect: START 22
    ! expect: main
    ! do: e-stop, run 1, stop, run 1
    ! case: e_stop_routines=false
    ! Also where the stop is over before the task has had a turn.
    ! do: start, run 0.5
    ! expect: POWER_ON 12
    ! expect: START 22
    ! expect: main
    ! do: e-stop, reset-e-stop, motors-on, start, run 1.2
    ! expect: RESTART 52
    ! expect: end
    PROC power_on()
        tell "POWER_ON";
    ENDPROC
    PROC started()
        tell "START";
    ENDPROC
    PROC stopped()
        tell "STOP";
    ENDPROC
    PROC quick()
        tell "QSTOP";
    ENDPROC
    PROC again()
        tell "RESTART";
    ENDPROC
    PROC reset_all()
        tell "RESET";
    ENDPROC
    PROC tell(string event)
        TPWrite event + " " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC main()
        TPWrite "main";
        WaitTime 1;
        TPWrite "end";
        WaitTime 100;
    ENDPROC
ENDMODULE
