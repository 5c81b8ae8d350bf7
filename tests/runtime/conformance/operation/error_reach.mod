MODULE error_reach
    ! source: [code] motion_program_exec: public loggers watch other tasks from one of their own; a switch
    ! task: T_OTHER other
    ! case: error_reach=all
    ! do: start, run 1.5
    ! expect: mine
    ! expect: theirs
    ! case: error_reach=own
    ! do: start, run 1.5
    ! expect: mine
    VAR intnum event;
    PROC main()
        CONNECT event WITH on_event;
        IError COMMON_ERR, TYPE_ALL, event;
        ErrWrite \I, "mine", "";
        WaitTime 2;
    ENDPROC
    TRAP on_event
        VAR trapdata data;
        VAR errdomain domain;
        VAR num number;
        VAR errtype type;
        VAR string title;
        GetTrapData data;
        ReadErrData data, domain, number, type \Title:=title;
        IF title = "mine" OR title = "theirs" TPWrite title;
    ENDTRAP
    PROC other()
        WaitTime 1;
        ErrWrite \I, "theirs", "";
    ENDPROC
ENDMODULE
