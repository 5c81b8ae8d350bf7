MODULE events_of_a_run
    ! source: [DB] EventType and ExecLevel inside and outside of event routines; Stop and the next start
    ! hook: power POWER_ON T_ROB1
    ! hook: started START T_ROB1
    ! hook: again RESTART T_ROB1
    ! do: start, run 5
    ! expect: power 1
    ! expect: start 22
    ! expect: main 00
    ! state: stopped
    ! do: start, run 5
    ! expect: restart
    ! expect: end
    PROC power()
        TPWrite "power " + ValToStr(EventType());
    ENDPROC
    PROC started()
        TPWrite "start " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC again()
        TPWrite "restart";
    ENDPROC
    PROC main()
        TPWrite "main " + ValToStr(EventType()) + ValToStr(ExecLevel());
        WaitTime 1;
        Stop;
        TPWrite "end";
        EXIT;
    ENDPROC
ENDMODULE
