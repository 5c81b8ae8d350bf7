MODULE sync_move
    ! source: 3HAC050917 arguments [manual]; list rows without a name: ETH's and Gramazio Kohler's cells [code]; MultiMove [mem]
    ! task: T_ROB2 second
    ! robot: irb120
    ! expect: one FALSE
    ! expect: two TRUE TRUE
    ! expect: suspended FALSE
    ! expect: resumed TRUE
    ! expect: one FALSE FALSE
    ! expect: ERR_SYNCMOVEON
    ! expect: undone FALSE
    PERS tasks both{3} := [["T_ROB1"],["T_ROB2"],[""]];
    VAR syncident begins;
    VAR syncident ends;
    VAR syncident begins_again;
    VAR syncident never;

    PROC main()
        TPWrite "one " \Bool:=IsSyncMoveOn();
        SyncMoveOn begins, both;
        TPWrite "two " + ValToStr(IsSyncMoveOn()) + " " + ValToStr(TasksInSync(both));
        StorePath \KeepSync;
        SyncMoveSuspend;
        TPWrite "suspended " \Bool:=IsSyncMoveOn();
        SyncMoveResume;
        RestoPath;
        TPWrite "resumed " \Bool:=IsSyncMoveOn();
        SyncMoveOff ends;
        TPWrite "one " + ValToStr(IsSyncMoveOn()) + " " + ValToStr(TasksInSync(both));
        SyncMoveOn never, both \TimeOut:=0.5;
        SyncMoveOn begins_again, both;
        SyncMoveUndo;
        TPWrite "undone " \Bool:=IsSyncMoveOn();
    ERROR
        IF ERRNO = ERR_SYNCMOVEON TPWrite "ERR_SYNCMOVEON";
        TRYNEXT;
    ENDPROC

    PROC second()
        WaitTime 0.3;
        SyncMoveOn begins, both;
        StorePath \KeepSync;
        SyncMoveSuspend;
        SyncMoveResume;
        RestoPath;
        WaitTime 0.3;
        SyncMoveOff ends;
        SyncMoveOn begins_again, both;
    ENDPROC
ENDMODULE
