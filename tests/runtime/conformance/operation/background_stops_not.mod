MODULE background_stops_not
    ! source: [S4 overview 4-45] a stop is for the NORMAL tasks: background tasks go on and run no STOP routine
    ! task: T_BACK back SEMISTATIC
    ! hook: stopped STOP T_BACK
    ! hook: stopped QSTOP T_BACK
    ! do: start, run 0.5, stop, run 0.5
    ! expect: back
    ! expect: back
    ! state: stopped running
    ! do: e-stop, run 0.5
    ! expect: back
    ! state: stopped running
    PROC main()
        WaitTime 100;
    ENDPROC
    PROC back()
        WaitTime 0.4;
        TPWrite "back";
        back;
    ENDPROC
    PROC stopped()
        TPWrite "never";
    ENDPROC
ENDMODULE
