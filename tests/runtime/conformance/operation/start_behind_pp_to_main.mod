MODULE start_behind_pp_to_main
    ! source: [S4 overview 4-24] UNDO, then RESET, then START; variables are initialised
    ! hook: reset_all RESET T_ROB1
    ! hook: started START T_ROB1
    ! hook: stopped STOP T_ROB1
    ! do: start, run 1, stop, pp-to-main, start, run 1
    ! expect: START 22
    ! expect: main 1
    ! expect: undo
    ! expect: RESET 62
    ! expect: START 22
    ! expect: main 1
    ! state: running
    VAR num n := 1;
    PROC reset_all()
        tell "RESET";
    ENDPROC
    PROC started()
        tell "START";
    ENDPROC
    PROC stopped()
        tell "STOP";
    ENDPROC
    PROC tell(string event)
        TPWrite event + " " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC main()
        TPWrite "main " + ValToStr(n);
        n := 2;
        inner;
    ENDPROC
    PROC inner()
        WaitTime 9;
    UNDO
        WaitTime 0.5;
        TPWrite "undo";
    ENDPROC
ENDMODULE
