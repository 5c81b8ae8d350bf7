MODULE start_waits_for_stop_routine
    ! source: [mem] a start waits for the STOP routine; a stop during it is a stop of what was started meanwhile
    ! hook: stopped STOP T_ROB1
    ! hook: again RESTART T_ROB1
    ! case:
    ! do: start, run 0.5, stop, run 0.2, start, run 0.5
    ! do: run 2
    ! expect: stopped
    ! expect: again
    ! expect: main
    ! case:
    ! do: start, run 0.5, stop, run 0.2, start, run 0.2, stop, run 5
    ! expect: stopped
    ! expect: stopped
    ! state: stopped
    PROC stopped()
        WaitTime 1;
        TPWrite "stopped";
    ENDPROC
    PROC again()
        TPWrite "again";
    ENDPROC
    PROC main()
        WaitTime 0.7;
        TPWrite "main";
        WaitTime 9;
    ENDPROC
ENDMODULE
