!=== background_stops_not
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
!=== break_from_inside
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
!=== calc_in_background
MODULE calc_in_background
    ! source: [ABB] a library's background task computes positions without a robot of its own; a switch
    ! robot: irb120
    ! task: T_BACK back
    ! case: calc_in_background=true
    ! do: start, run 1
    ! expect: 30
    ! case: calc_in_background=false
    ! do: start, run 1
    ! expect: refused
    PROC main()
        WaitTime 0.5;
    ENDPROC
    PROC back()
        VAR robtarget there;
        VAR jointtarget again;
        there := CalcRobT([[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], tool0 \WObj:=wobj0);
        again := CalcJointT(there, tool0 \WObj:=wobj0);
        TPWrite ValToStr(again.robax.rax_5);
        Stop;
    ERROR
        IF ERRNO = ERR_NOT_MOVETASK TPWrite "refused";
        Stop;
    ENDPROC
ENDMODULE
!=== data_of_tasks
MODULE data_of_tasks
    ! source: [code] recovery programs read robtargets with \TaskName; a switch
    ! robot: irb120
    ! task: T_BACK back
    ! case: data_of_tasks=true
    ! do: start, run 1
    ! expect: 30
    ! expect: 31
    ! case: data_of_tasks=false
    ! do: start, run 1
    ! expect: refused
    TASK PERS num own := 30;
    PROC main()
        WaitTime 0.5;
    ENDPROC
    PROC back()
        VAR num found;
        VAR num next := 31;
        own := 4;
        GetDataVal "own" \TaskName:="T_ROB1", found;
        TPWrite ValToStr(found);
        SetDataVal "own" \TaskName:="T_ROB1", next;
        GetDataVal "own" \TaskName:="T_ROB1", found;
        TPWrite ValToStr(found);
        Stop;
    ERROR
        IF ERRNO = ERR_TASKNAME TPWrite "refused";
        Stop;
    ENDPROC
ENDMODULE
!=== error_in_event_routine
MODULE error_in_event_routine
    ! source: [K §7.2] levels are left by long jumps only: an error there is not for the handlers of the program
    ! hook: stopped STOP T_ROB1
    ! fault: error 7 8
    ! do: start, run 0.5, stop, run 0.1
    ! state: error
    PROC stopped()
        RAISE 7;
    ERROR
        RAISE;
    ENDPROC
    PROC main()
        WaitTime 9;
    ERROR
        TPWrite ValToStr(ERRNO);
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== error_reach
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
!=== events
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
!=== events_of_a_run
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
!=== fault_runs_stop_routines
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
!=== handled_errors_are_warnings
MODULE handled_errors_are_warnings
    ! source: [K §7.5] the event log says so, unless SkipWarn was executed
    ! do: start, run 1
    ! log: 194199 Task T_ROB1: error 1 at /handled_errors_are_warnings/fails/RAISE/10.
    PROC main()
        fails 1;
        fails 2;
    ENDPROC
    PROC fails(num n)
        RAISE n;
    ERROR
        IF ERRNO = 2 SkipWarn;
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== interrupts_in_event_routines
MODULE interrupts_in_event_routines
    ! source: [S4 overview 4-39] they are lost in a STOP routine and wait in a RESTART routine
    ! hook: stopped STOP T_ROB1
    ! hook: again RESTART T_ROB1
    ! do: start, run 0.5, stop, run 1
    ! value: p = 1
    ! do: start, run 1.3
    ! expect: restart
    ! expect: trap
    ! expect: main
    VAR intnum i;
    PERS num p := 0;
    PROC stopped()
        p := p + 1;
        WaitTime 0.1;
    ENDPROC
    PROC again()
        p := p + 1;
        WaitTime 0.1;
        TPWrite "restart";
    ENDPROC
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        WaitTime 1;
        TPWrite "main";
        WaitTime 9;
    ENDPROC
ENDMODULE
!=== interrupts_on_hold
MODULE interrupts_on_hold
    ! source: [S4 datasys 1-intnum-2] a queue holds 30
    ! case:
    ! do: set count 30, start, run 1.5
    ! state: running
    ! case:
    ! do: set count 31, start, run 1.5
    ! state: error
    ! fault: 194224 22
    VAR intnum i;
    PERS num p := 0;
    PERS num count := 0;
    TRAP t
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        IDisable;
        FOR k FROM 1 TO count DO
            p := p + 1;
        ENDFOR
        WaitTime 1;
        IEnable;
        WaitTime 1;
    ENDPROC
ENDMODULE
!=== long_jump_out_of_event_routine
MODULE long_jump_out_of_event_routine
    ! source: [K §7.2] levels are left by long jumps
    ! hook: stopped STOP T_ROB1
    ! do: start, run 0.5, stop, start, run 0.1
    ! expect: 7
    PROC stopped()
        RAISE 7;
    ERROR
        RAISE;
    ENDPROC
    PROC main()
        WaitTime 9;
    ERROR (7)
        TPWrite ValToStr(ERRNO);
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== installed_modules_exist
MODULE installed_modules_exist
    ! source: no source names the modules of ModExist: a switch
    ! robot: irb120
    ! case: installed_modules_exist=true
    ! do: start, run 1
    ! expect: TRUE
    ! expect: FALSE
    ! case: installed_modules_exist=false
    ! do: start, run 1
    ! expect: FALSE
    ! expect: FALSE
    PROC main()
        TPWrite ValToStr(ModExist("installed_modules_exist"));
        TPWrite ValToStr(ModExist("nothing"));
    ENDPROC
ENDMODULE
!=== move_in_background
MODULE move_in_background
    ! source: [S4 overview 4-48] moves are a motion task's
    ! robot: irb120
    ! task: T_BACK back SEMISTATIC
    ! do: start, run 1
    ! expect: at 0
    ! state: running error
    ! fault: 194901 11
    CONST jointtarget there := [[10,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC back()
        MoveAbsJ there, v100, fine, tool0;
    ENDPROC
    PROC main()
        VAR jointtarget here;
        WaitTime 0.5;
        here := CJointT();
        TPWrite "at " + ValToStr(here.robax.rax_1);
        WaitTime 9;
    ENDPROC
ENDMODULE
!=== next_symbol
MODULE next_symbol
    ! source: [code] programs that seek camera devices or units, and their own data; a switch
    ! robot: irb120
    ! case: next_symbol=level
    ! do: start, run 1
    ! expect: tool0
    ! expect: my_tool
    ! case: next_symbol=below
    ! do: start, run 1
    ! expect: my_tool tool0
    ! expect: my_tool
    PERS tooldata my_tool := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    VAR datapos block;
    VAR string name;

    PROC main()
        SetDataSearch "tooldata";
        logged;
        SetDataSearch "tooldata" \InMod:="next_symbol";
        logged;
    ENDPROC

    PROC logged()
        VAR string names := "";
        WHILE GetNextSym(name, block) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        IF names = "" names := "nothing";
        TPWrite names;
    ENDPROC
ENDMODULE
!=== pointer_moved
MODULE pointer_moved
    ! source: [S4 overview 4-24] what survives PP to a routine, PP to cursor, a service routine, a warm start
    ! case:
    ! Variables anew, persistents as they were, no interrupt, no open file.
    ! do: start, run 1, stop, run 0.1, routine routine, run 0.1
    ! state: ready
    ! do: start, run 9
    ! expect: routine 112
    ! expect: closed
    ! expect: written
    ! state: finished
    ! do: start, run 9
    ! expect: behind 1224
    ! expect: trap
    ! expect: written
    ! do: routine missing
    ! refused: routine missing
    ! case:
    ! do: start, run 1, stop, run 0.1, cursor -18
    ! refused: cursor -18
    ! do: cursor 1, run 0.1
    ! at: main TPWrite "behind " + show() + ValToStr(own);
    ! do: start, run 3
    ! expect: behind 1224
    ! expect: trap
    ! expect: written
    ! case:
    ! do: start, run 1, stop, run 0.1, service service, run 1
    ! expect: service 112220
    ! state: stopped
    ! do: start, run 9
    ! expect: behind 11224
    ! expect: trap
    ! expect: written
    ! do: service service, run 1
    ! expect: service 122220
    ! state: finished
    ! do: start, service service
    ! refused: service service
    ! case:
    ! do: start, run 1, stop, run 0.1, power-loss, run 1
    ! state: stopped
    ! do: motors-on, start, run 9
    ! expect: behind 1224
    ! expect: trap
    ! expect: closed
    ! expect: written
    CONST num c := 1;
    VAR num v := 1;
    PERS num p := 1;
    PERS num bell := 0;
    VAR intnum i;
    VAR iodev f;
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        VAR num own := 3;
        CONNECT i WITH t;
        IPers bell, i;
        Open "HOME:/x.txt", f \Write;
        v := 2;
        p := 2;
        own := 4;
        WaitTime 5;
        TPWrite "behind " + show() + ValToStr(own);
        ring;
    ENDPROC
    PROC ring()
        bell := bell + 1;
        WaitTime 1;
        Write f, "x";
        TPWrite "written";
    ERROR
        TPWrite "closed";
        TRYNEXT;
    ENDPROC
    PROC routine()
        TPWrite "routine " + show();
        ring;
    ENDPROC
    PROC service()
        v := v + 10;
        TPWrite "service " + show() + ValToStr(ExecLevel()) + ValToStr(EventType());
    ENDPROC
    FUNC string show()
        RETURN ValToStr(c) + ValToStr(v) + ValToStr(p);
    ENDFUNC
ENDMODULE
!=== power_loss
MODULE power_loss
    ! source: [manual IPACV] no STOP routine, POWER_ON when it is back; SEMISTATIC begins anew, NORMAL waits for a start
    ! task: T_BACK back SEMISTATIC
    ! hook: power_on POWER_ON T_ROB1
    ! hook: never STOP T_ROB1
    ! hook: back_power_on POWER_ON T_BACK
    ! hook: back_reset RESET T_BACK
    ! hook: back_start START T_BACK
    ! hook: never STOP T_BACK
    ! do: start, run 0.1
    ! expect: POWER_ON 12
    ! expect: main
    ! expect: b POWER_ON 12
    ! expect: b START 22
    ! expect: b main
    ! do: power-loss, run 0.5
    ! expect: POWER_ON 12
    ! expect: b POWER_ON 12
    ! expect: b RESET 62
    ! expect: b START 22
    ! expect: b main
    ! state: stopped running
    PROC power_on()
        tell "POWER_ON";
    ENDPROC
    PROC back_power_on()
        tell "b POWER_ON";
    ENDPROC
    PROC back_reset()
        tell "b RESET";
    ENDPROC
    PROC back_start()
        tell "b START";
    ENDPROC
    PROC never()
        tell "never";
    ENDPROC
    PROC tell(string event)
        TPWrite event + " " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC main()
        TPWrite "main";
        WaitTime 100;
    ENDPROC
    PROC back()
        TPWrite "b main";
        WaitTime 100;
    ENDPROC
ENDMODULE
!=== power_loss_at_once
MODULE power_loss_at_once
    ! source: [manual IPACV] power is lost before the first statement: SEMISTATIC begins, NORMAL waits for a start
    ! task: T_BACK back SEMISTATIC
    ! hook: on_start START T_ROB1
    ! hook: on_start START T_BACK
    ! do: start, power-loss, run 0.5
    ! expect: b main
    ! state: stopped running
    PROC on_start()
    ENDPROC
    PROC main()
        WaitTime 9;
    ENDPROC
    PROC back()
        TPWrite "b main";
        WaitTime 9;
    ENDPROC
ENDMODULE
!=== power_on_stores
MODULE power_on_stores
    ! source: [code] CAB_EXEC_HOOKS: what POWER_ON stored is there at START
    ! hook: power_on POWER_ON T_ROB1
    ! do: run 1, start, run 1
    ! expect: 5
    VAR num v := 0;
    PROC power_on()
        v := 5;
    ENDPROC
    PROC main()
        TPWrite ValToStr(v);
    ENDPROC
ENDMODULE
!=== pp_to_main
MODULE pp_to_main
    ! source: [S4 overview 4-24] it initialises variables, keeps persistents and runs UNDO
    ! do: start, run 1, stop, pp-to-main, run 0.1
    ! expect: 22
    ! expect: undo
    ! state: ready
    ! log: 10002 Task T_ROB1: the program pointer was set to main.
    ! do: start, run 1
    ! expect: 23
    VAR num v := 1;
    PERS num p := 1;
    PROC main()
        v := v + 1;
        p := p + 1;
        TPWrite ValToStr(v) + ValToStr(p);
        inner;
    ENDPROC
    PROC inner()
        WaitTime 100;
    UNDO
        TPWrite "undo";
    ENDPROC
ENDMODULE
!=== safe_orders
MODULE safe_orders
    ! source: [S4 overview 4-39] an order is lost while the program stands; RobotWare manuals: \SingleSafe waits
    ! do: start, run 1, stop, run 1, set single 1, set safe 1, run 1
    ! do: start, run 1
    ! expect: safe
    VAR intnum i;
    VAR intnum j;
    PERS num single := 0;
    PERS num safe := 0;
    TRAP lost
        TPWrite "single";
    ENDTRAP
    TRAP kept
        TPWrite "safe";
    ENDTRAP
    PROC main()
        CONNECT i WITH lost;
        CONNECT j WITH kept;
        IPers \Single, single, i;
        IPers \SingleSafe, safe, j;
        WaitTime 5;
    ENDPROC
ENDMODULE
!=== search_pattern
MODULE search_pattern
    ! source: [ABB] programs for the cameras of hands write a prefix and .*; a switch
    ! robot: irb120
    ! case: search_pattern=whole
    ! do: start, run 1
    ! expect: part
    ! expect: part2 part
    ! expect: part
    ! case: search_pattern=part
    ! do: start, run 1
    ! expect: part2 part
    ! expect: part2 part
    ! expect: part
    PERS num part2 := 2;
    PERS num part := 1;
    VAR datapos block;
    VAR string name;

    PROC main()
        SetDataSearch "num" \Object:="part" \InMod:="search_pattern";
        logged;
        SetDataSearch "num" \Object:="^part.*$" \InMod:="search_pattern";
        logged;
        SetDataSearch "num" \Object:="^part$" \InMod:="search_pattern";
        logged;
    ENDPROC

    PROC logged()
        VAR string names := "";
        WHILE GetNextSym(name, block) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        IF names = "" names := "nothing";
        TPWrite names;
    ENDPROC
ENDMODULE
!=== send_attends
MODULE send_attends
    ! source: no manual settles whether a trap comes while SocketSend waits: a switch
    ! task: T_PEER peer
    ! case: send_attends=true
    ! do: start, run 70
    ! expect: 1
    ! case: send_attends=false
    ! do: start, run 70
    ! expect: 60
    VAR socketdev server;
    VAR socketdev client;
    VAR rawbytes data;
    VAR intnum alarm;
    VAR clock watch;
    PROC main()
        PackRawBytes 0, data, 1021 \IntX:=DINT;
        SocketCreate server;
        SocketBind server, "10.0.0.1", 5000;
        SocketListen server;
        SocketAccept server, client;
        CONNECT alarm WITH on_alarm;
        ITimer \Single, 1, alarm;
        ClkStart watch;
        WHILE TRUE DO
            SocketSend client \RawData:=data;
        ENDWHILE
    ERROR
        TPWrite ValToStr(Round(ClkRead(watch)));
        EXIT;
    ENDPROC
    TRAP on_alarm
        SocketClose client;
    ENDTRAP
    PROC peer()
        VAR socketdev own;
        WaitTime 0.1;
        SocketCreate own;
        SocketConnect own, "10.0.0.1", 5000;
        WaitTime 100;
    ENDPROC
ENDMODULE
!=== start_behind_pp_to_main
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
!=== start_waits_for_stop_routine
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
!=== stop_from_inside
MODULE stop_from_inside
    ! source: [mem] it runs the STOP routines of all NORMAL tasks; [S4 2-Stop-1] the next start goes on behind it
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
        Stop;
        TPWrite "on";
        WaitTime 9;
    ENDPROC
    PROC other()
        WaitTime 9;
    ENDPROC
ENDMODULE
!=== stop_in_event_routine
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
!=== stop_owner
MODULE stop_owner
    ! source: no manual settles whose stop a StartMove of a background task takes back: a motion setting
    ! robot: irb120
    ! task: T_STOPS stops SEMISTATIC
    ! task: T_STARTS starts SEMISTATIC
    ! case: motion.stop_owner=kind
    ! do: start, run 1.5
    ! expect: stands
    ! do: run 20
    ! expect: goes on
    ! case: motion.stop_owner=task
    ! do: start, run 1.5
    ! expect: stands
    ! do: run 20
    PROC main()
        MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
        EXIT;
    ENDPROC
    PROC stops()
        VAR jointtarget here;
        WaitTime 0.5;
        StopMove;
        WaitTime 0.8;
        here := CJointT(\TaskName:="T_ROB1");
        IF here.robax.rax_1 > 0 AND here.robax.rax_1 < 60 TPWrite "stands";
        WaitTime 60;
    ENDPROC
    PROC starts()
        VAR jointtarget here;
        VAR jointtarget later;
        WaitTime 1.4;
        here := CJointT(\TaskName:="T_ROB1");
        WaitTime 0.6;
        IF IsStopMoveAct(\FromNonMoveTask) StartMove;
        WaitTime 10;
        later := CJointT(\TaskName:="T_ROB1");
        IF later.robax.rax_1 > here.robax.rax_1 + 57 TPWrite "goes on";
        WaitTime 60;
    ENDPROC
ENDMODULE
!=== stop_takes_start_back
MODULE stop_takes_start_back
    ! source: [mem] a stop takes a start back that waits for PP to main
    ! do: start, run 0.1, pp-to-main, start, stop, run 1
    ! expect: main
    ! state: ready
    PROC main()
        TPWrite "main";
        WaitTime 9;
    ENDPROC
ENDMODULE
!=== wait_begins_anew
MODULE wait_begins_anew
    ! source: [S4 overview 5-23] a stopped wait counts from its beginning again
    ! do: start, run 1.5, stop, run 1, start, run 1.9
    ! do: run 0.2
    ! expect: done
    PROC main()
        WaitTime 2;
        TPWrite "done";
    ENDPROC
ENDMODULE
