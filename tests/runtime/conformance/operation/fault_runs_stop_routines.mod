MODULE fault_runs_stop_routines
    ! source: [S4 overview 4-45] a fault stops the other NORMAL tasks and their STOP routines run; [mem] whether its own do
    ! task: T_OTHER other
    ! hook: stopped STOP T_ROB1
    ! hook: quick QSTOP T_ROB1
    ! hook: other_stopped STOP T_OTHER
    ! hook: quick QSTOP T_OTHER
    ! case: fault_routines=true
    ! do: start, run 2
    ! expect: STOP 32
    ! expect: other STOP 32
    ! state: error stopped
    ! fault: error 7 31
    ! case: fault_routines=false
    ! do: start, run 2
    ! expect: other STOP 32
    ! state: error stopped
    ! fault: error 7 31
    PROC stopped()
        TPWrite "STOP " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC other_stopped()
        TPWrite "other STOP " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC quick()
        TPWrite "QSTOP";
    ENDPROC
    PROC main()
        WaitTime 1;

        RAISE 7;
    ENDPROC
    PROC other()
        WaitTime 9;
    ENDPROC
ENDMODULE
