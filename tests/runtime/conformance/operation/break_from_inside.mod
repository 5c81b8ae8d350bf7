MODULE break_from_inside
    ! source: [mem] it runs the STOP routines of all NORMAL tasks; [S4 2-Break-1] the next start goes on behind it
    ! task: T_OTHER other
    ! hook: stopped STOP T_ROB1
    ! hook: again RESTART T_ROB1
    ! hook: other_stopped STOP T_OTHER
    ! hook: other_again RESTART T_OTHER
    ! do: start, run 1
    ! expect: STOP 32
    ! expect: other STOP 32
    ! do: start, run 1
    ! expect: RESTART 52
    ! expect: on
    ! expect: other RESTART 52
    PROC stopped()
        tell "STOP";
    ENDPROC
    PROC again()
        tell "RESTART";
    ENDPROC
    PROC other_stopped()
        tell "other STOP";
    ENDPROC
    PROC other_again()
        tell "other RESTART";
    ENDPROC
    PROC tell(string event)
        TPWrite event + " " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC main()
        Break;
        TPWrite "on";
        WaitTime 9;
    ENDPROC
    PROC other()
        WaitTime 9;
    ENDPROC
ENDMODULE
