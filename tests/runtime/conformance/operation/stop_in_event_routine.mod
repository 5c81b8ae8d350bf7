MODULE stop_in_event_routine
    ! source: [S4 2-Stop-1] it leaves the routine, which begins anew at the next event; [mem] whether STOP routines run
    ! hook: started START T_ROB1
    ! hook: stopped STOP T_ROB1
    ! case: event_stops=false
    ! do: start, run 1
    ! expect: begun
    ! state: stopped
    ! do: start, run 1
    ! expect: main
    ! case: event_stops=true
    ! do: start, run 1
    ! expect: begun
    ! expect: stop
    ! state: stopped
    ! do: start, run 1
    ! expect: main
    PROC started()
        TPWrite "begun";
        Stop;
        TPWrite "never";
    ENDPROC
    PROC stopped()
        TPWrite "stop";
    ENDPROC
    PROC main()
        TPWrite "main";
    ENDPROC
ENDMODULE
