!=== connect_twice
MODULE connect_twice
! source: [K §4.12, 12] a connected number cannot be connected again: ERR_ALRDYCNT; IDelete frees it
  VAR intnum i;
  PROC main()
    CONNECT i WITH a;
    CONNECT i WITH a;
    CONNECT i WITH b;
    IDelete i;
    CONNECT i WITH b;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    ! expect: ALRDYCNT
    ! expect: ALRDYCNT
    ! expect: b
  ERROR
    IF ERRNO = ERR_ALRDYCNT TPWrite "ALRDYCNT";
    TRYNEXT;
  ENDPROC
  TRAP a
    TPWrite "a";
  ENDTRAP
  TRAP b
    TPWrite "b";
  ENDTRAP
ENDMODULE
!=== delete
MODULE delete
! source: [S4 datasys 2-IDelete-1, 2-ISleep-1,2] event and connection go; another CONNECT is needed
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    IDelete i;
    p := 2;
    WaitTime 0.1;
    ISleep i;
    CONNECT i WITH t;
    IPers p, i;
    p := 3;
    WaitTime 0.1;
    ! expect: trap 1
    ! expect: unknown
    ! expect: trap 3
  ERROR
    IF ERRNO = ERR_UNKINO TPWrite "unknown";
    TRYNEXT;
  ENDPROC
  TRAP t
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
!=== delete_queued
MODULE delete_queued
! source: [S4 datasys 2-IDelete-1] a deleted interrupt is not served any more: one that is queued
! because interrupts are disabled, one that is on its way (K §8.1: 2 to 30 ms), each of several; those
! of other interrupts are served, in their order
  VAR intnum first;
  VAR intnum second;
  PERS num p := 0;
  PERS num q := 0;
  PROC main()
    CONNECT first WITH t1;
    CONNECT second WITH t2;
    IPers p, first;
    IPers q, second;
    IDisable;
    p := 1;
    q := 1;
    p := 2;
    q := 2;
    WaitTime 0.1;
    IDelete first;
    IEnable;
    ! expect: second
    ! expect: second
    q := 3;
    IDelete second;
    WaitTime 0.1;
    CONNECT first WITH t1;
    WaitTime 0.1;
    TPWrite "end";
    ! expect: end
  ENDPROC
  TRAP t1
    TPWrite "first";
  ENDTRAP
  TRAP t2
    TPWrite "second";
  ENDTRAP
ENDMODULE
!=== disable_queues
MODULE disable_queues
! source: [K §8.2, manual DB] between IDisable and IEnable events queue and come in order
  PERS num p := 0;
  VAR intnum i;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    IDisable;
    p := 1;
    p := 2;
    WaitTime 1;
    TPWrite "enable";
    IEnable;
    TPWrite "end";
    ! expect: enable
    ! expect: trap
    ! expect: trap
    ! expect: end
  ENDPROC
  TRAP changed
    TPWrite "trap";
  ENDTRAP
ENDMODULE
!=== error_is_fatal
MODULE error_is_fatal
! source: [K §8.3, manual BC/112] an error that leaves a trap is not passed to what it interrupted
! fault: ERR_DIVZERO 17
  VAR intnum i;
  PROC main()
    CONNECT i WITH bad;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    TPWrite "never";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  TRAP bad
    VAR num z;
    ! here
    z := 1 / z;
  ENDTRAP
ENDMODULE
!=== error_numbers
MODULE error_numbers
! source: [S4 datasys 2-IError, 2-ReadErrData; event log: a code is domain * 10000 + number] with an
! error number only that event of the domain and type interrupts
  VAR intnum one;
  VAR intnum other;
  VAR intnum warned;
  VAR intnum elsewhere;
  VAR trapdata found;
  PROC main()
    CONNECT one WITH logged;
    CONNECT other WITH never;
    CONNECT warned WITH never;
    CONNECT elsewhere WITH never;
    IError PROCESS_ERR \ErrorId:=5031, TYPE_ALL, one;
    IError PROCESS_ERR \ErrorId:=5030, TYPE_ALL, other;
    IError PROCESS_ERR \ErrorId:=5031, TYPE_WARN, warned;
    IError SYSTEM_ERR \ErrorId:=5031, TYPE_ALL, elsewhere;
    ErrLog 5031, \I, "title", "a", "b", "c", "d";
    WaitTime 0.1;
    ErrLog 5032, \I, "next", "a", "b", "c", "d";
    WaitTime 0.1;
    TPWrite "end";
    ! expect: 11 5031 1 ErrLog
    ! expect: end
  ENDPROC
  TRAP logged
    VAR errdomain domain;
    VAR num number;
    VAR errtype kind;
    VAR string title;
    GetTrapData found;
    ReadErrData found, domain, number, kind \Title:=title;
    TPWrite ValToStr(domain) + " " + ValToStr(number) + " " + ValToStr(kind) + " " + title;
  ENDTRAP
  TRAP never
    TPWrite "never";
  ENDTRAP
ENDMODULE
!=== exit_cycle_in_trap
MODULE exit_cycle_in_trap
! source: [S4 datasys 2-ExitCycle-1, abb_driver] ExitCycle in a trap drops what it interrupted; the order stays
! cycle: 5
  PERS num p := 0;
  VAR intnum i;
  VAR num cycles := 0;
  PROC main()
    Incr cycles;
    TPWrite "main " + ValToStr(cycles);
    IDelete i;
    CONNECT i WITH changed;
    IPers p, i;
    IF cycles > 2 EXIT;
    p := p + 1;
    WaitTime 10;
    TPWrite "never";
    ! expect: main 1
    ! expect: trap
    ! expect: main 2
    ! expect: trap
    ! expect: main 3
  ENDPROC
  TRAP changed
    TPWrite "trap";
    ExitCycle;
  ENDTRAP
ENDMODULE
!=== interrupts_any
MODULE interrupts_any
! source: K 8 any number; [mem] 100, then ERR_INOMAX
! dialect: interrupts_limited=false
  VAR intnum many{110};
  PROC main()
    VAR num n := 0;
    FOR i FROM 1 TO 110 DO
      CONNECT many{i} WITH nothing;
      Incr n;
    ENDFOR
    TPWrite ValToStr(n);
    ! expect: 110
  ERROR
    IF ERRNO = ERR_INOMAX THEN
      TPWrite ValToStr(n);
      RETURN;
    ENDIF
  ENDPROC
  TRAP nothing
  ENDTRAP
ENDMODULE
!=== interrupts_limited
MODULE interrupts_limited
! source: K 8 any number; [mem] 100, then ERR_INOMAX
  VAR intnum many{110};
  PROC main()
    VAR num n := 0;
    FOR i FROM 1 TO 110 DO
      CONNECT many{i} WITH nothing;
      Incr n;
    ENDFOR
    TPWrite ValToStr(n);
    ! expect: 100
  ERROR
    IF ERRNO = ERR_INOMAX THEN
      TPWrite ValToStr(n);
      RETURN;
    ENDIF
  ENDPROC
  TRAP nothing
  ENDTRAP
ENDMODULE
!=== intno
MODULE intno
! source: [S4 overview 4-39] INTNO tells which interrupt it is; several may share one trap
  VAR intnum first;
  VAR intnum second;
  PERS num p := 0;
  PERS num q := 0;
  PROC main()
    CONNECT first WITH t;
    CONNECT second WITH t;
    IPers p, first;
    IPers q, second;
    q := 1;
    WaitTime 0.1;
    p := 1;
    WaitTime 0.1;
    ! expect: second
    ! expect: first
  ENDPROC
  TRAP t
    IF INTNO = first TPWrite "first";
    IF INTNO = second TPWrite "second";
  ENDTRAP
ENDMODULE
!=== ipers
MODULE ipers_shown
! source: [K §8, 1A/184] fires when the value changes, not when the same is stored; ITNO names it
  PERS num p := 1;
  VAR intnum i;
  VAR num seen := 0;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    TPWrite ValToStr(seen);
    ! expect: 0
    p := 2;
    WaitTime 0.1;
    TPWrite ValToStr(seen);
    ! expect: trap 2 TRUE
    ! expect: 1
    p := 3;
    WHILE seen < 2 DO
    ENDWHILE
    TPWrite "loop left";
    ! expect: trap 3 TRUE
    ! expect: loop left
  ENDPROC
  TRAP changed
    Incr seen;
    TPWrite "trap " + ValToStr(p) + " " + ValToStr(INTNO = i);
  ENDTRAP
ENDMODULE
!=== itimer
MODULE itimer_shown
! source: [S4 datasys 2-ITimer-1,2] first shot after one period, then each period; \Single once
  VAR intnum i;
  VAR intnum j;
  VAR num ticks := 0;
  VAR num once := 0;
  PROC main()
    CONNECT i WITH tick;
    CONNECT j WITH shot;
    ITimer 0.5, i;
    ITimer \Single, 0.2, j;
    WaitTime 5.3;
    TPWrite ValToStr(ticks) + " " + ValToStr(once);
    ! expect: 10 1
    IDelete i;
    WaitTime 2;
    TPWrite ValToStr(ticks);
    ! expect: 10
  ENDPROC
  TRAP tick
    Incr ticks;
  ENDTRAP
  TRAP shot
    Incr once;
  ENDTRAP
ENDMODULE
!=== long_jump_out
MODULE long_jump_out
! source: [K §7.2] a listed handler at a lower execution level may take an error out of a trap
  VAR intnum i;
  PROC main()
    CONNECT i WITH bad;
    ITimer \Single, 0.1, i;
    WaitTime 1;
    TPWrite "after the wait";
    ! expect: trap
    ! expect: main TRUE
    ! expect: after the wait
  ERROR (ERR_DIVZERO)
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  TRAP bad
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "trap";
    RAISE;
  ENDTRAP
ENDMODULE
!=== no_nesting
MODULE no_nesting
! source: [K §8.2, 8.3] while a trap runs interrupts wait, then they are raised in order
  PERS num p := 0;
  VAR intnum i;
  VAR intnum j;
  PROC main()
    CONNECT i WITH slow;
    CONNECT j WITH quick;
    IPers p, i;
    ITimer \Single, 0.5, j;
    p := 1;
    WaitTime 3;
    TPWrite "end";
    ! expect: slow begins
    ! expect: slow ends
    ! expect: quick
    ! expect: end
  ENDPROC
  TRAP slow
    TPWrite "slow begins";
    WaitTime 1;
    TPWrite "slow ends";
  ENDTRAP
  TRAP quick
    TPWrite "quick";
  ENDTRAP
ENDMODULE
!=== of_their_task
MODULE of_their_task
! source: [S4 overview 4-48, K §14.2] each task has its own interrupts: IDisable is one task's
! task: T_BACK other
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    IDisable;
    WaitTime 1;
    TPWrite "main";
    IEnable;
    WaitTime 0.1;
    ! expect: trap of T_BACK
    ! expect: main
    ! expect: trap of T_ROB1
  ENDPROC
  PROC other()
    CONNECT i WITH t;
    IPers p, i;
    WaitTime 0.1;
    p := 1;
    WaitTime 0.5;
  ENDPROC
  TRAP t
    TPWrite "trap of " + GetTaskName();
  ENDTRAP
ENDMODULE
!=== ordered_twice
MODULE ordered_twice
! source: [S4 datasys 2-ISignalDI] a second order without IDelete is not allowed
! fault: 194214 9
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    IPers p, i;
    TPWrite "never";
  ENDPROC
  TRAP t
  ENDTRAP
ENDMODULE
!=== pure_loop
MODULE pure_loop
! source: [K §8.1] a trap starts at the next statement, also in a loop that waits for nothing
  VAR intnum i;
  VAR bool stop_ := FALSE;
  PROC main()
    CONNECT i WITH tick;
    ITimer \Single, 0.5, i;
    WHILE NOT stop_ DO
    ENDWHILE
    TPWrite "left";
    ! expect: left
  ENDPROC
  TRAP tick
    stop_ := TRUE;
  ENDTRAP
ENDMODULE
!=== shortest_timer
MODULE shortest_timer
! source: a backup of a YuMi (bestin-07/ATOM_ABB-YUMI) [cfg] starts such a timer; 0.01 as a num is a little less
  VAR intnum i;
  PROC main()
    CONNECT i WITH t;
    ITimer \Single, 0.01, i;
    WaitTime 0.1;
    ! expect: trap
  ENDPROC
  TRAP t
    TPWrite "trap";
  ENDTRAP
ENDMODULE
!=== signals
MODULE signals
! source: [S4 datasys 2-ISignalDO-1,2] edges only: a level that is already there does not fire
! signal: do1 DO
  VAR intnum up;
  VAR intnum down;
  VAR intnum both;
  VAR num n{3};
  PROC main()
    SetDO do1, 1;
    CONNECT up WITH t_up;
    CONNECT down WITH t_down;
    CONNECT both WITH t_both;
    ISignalDO do1, 1, up;
    ISignalDO do1, 0, down;
    ISignalDO do1, edge, both;
    WaitTime 0.2;
    TPWrite ValToStr(n);
    ! expect: [0,0,0]
    SetDO do1, 1;
    SetDO do1, 0;
    SetDO do1, 1;
    WaitTime 0.2;
    TPWrite ValToStr(n);
    ! expect: [1,1,2]
  ENDPROC
  TRAP t_up
    Incr n{1};
  ENDTRAP
  TRAP t_down
    Incr n{2};
  ENDTRAP
  TRAP t_both
    Incr n{3};
  ENDTRAP
ENDMODULE
!=== single
MODULE single
! source: [S4 datasys 2-ISignalDO-1,2] \Single fires at most once; another order needs no CONNECT
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    CONNECT i WITH t;
    IPers \Single, p, i;
    p := 1;
    WaitTime 0.1;
    p := 2;
    WaitTime 0.1;
    IPers \Single, p, i;
    p := 3;
    WaitTime 0.1;
    ! expect: trap 1
    ! expect: trap 3
  ENDPROC
  TRAP t
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
!=== sleep_loses
MODULE sleep_loses
! source: [S4 datasys 2-ISleep-1,2] events during sleep are ignored for good; ERR_UNKINO
  PERS num p := 0;
  VAR intnum i;
  VAR intnum none;
  PROC main()
    CONNECT i WITH changed;
    IPers p, i;
    ISleep i;
    p := 1;
    WaitTime 1;
    IWatch i;
    WaitTime 1;
    p := 2;
    WaitTime 1;
    ISleep none;
    TPWrite "end";
    ! expect: trap 2
    ! expect: unknown
    ! expect: end
  ERROR
    IF ERRNO = ERR_UNKINO TPWrite "unknown";
    TRYNEXT;
  ENDPROC
  TRAP changed
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
ENDMODULE
!=== timer_any
MODULE timer_any
! source: S4 datasys 2-ITimer names no limit; [mem] 0.1 s, with \Single 0.01 s
! dialect: shortest_timer=any
  VAR intnum cyclic;
  VAR intnum once;
  VAR bool seen := FALSE;
  PROC main()
    CONNECT cyclic WITH ticks;
    CONNECT once WITH ticks;
    ITimer 0.05, cyclic;
    ITimer \Single, 0.005, once;
    WaitTime 1;
    IF seen TPWrite "tick";
    ! expect: tick
  ERROR
    IF ERRNO = ERR_ARGVALERR TPWrite "refused";
    TRYNEXT;
  ENDPROC
  TRAP ticks
    seen := TRUE;
    IDelete cyclic;
  ENDTRAP
ENDMODULE
!=== timer_too_short
MODULE timer_too_short
! source: S4 datasys 2-ITimer names no limit; [mem] 0.1 s, with \Single 0.01 s
  VAR intnum cyclic;
  VAR intnum once;
  VAR bool seen := FALSE;
  PROC main()
    CONNECT cyclic WITH ticks;
    CONNECT once WITH ticks;
    ITimer 0.05, cyclic;
    ITimer \Single, 0.005, once;
    WaitTime 1;
    IF seen TPWrite "tick";
    ! expect: refused
    ! expect: refused
  ERROR
    IF ERRNO = ERR_ARGVALERR TPWrite "refused";
    TRYNEXT;
  ENDPROC
  TRAP ticks
    seen := TRUE;
    IDelete cyclic;
  ENDTRAP
ENDMODULE
!=== trap_ways_out
MODULE trap_ways_out
! source: [S4 overview 4-39] a trap ends with RETURN or ENDTRAP, then the interrupted place goes on
  VAR intnum i;
  PERS num p := 0;
  PROC main()
    VAR num n := 5;
    CONNECT i WITH t;
    IPers p, i;
    p := 1;
    WaitTime 0.1;
    TPWrite "went on " + ValToStr(n);
    p := 2;
    WaitTime 0.1;
    TPWrite "went on " + ValToStr(n);
    p := 3;
    WaitTime 0.1;
    TPWrite "end";
    ! expect: trap 1
    ! expect: went on 5
    ! expect: trap 2
    ! expect: endtrap
    ! expect: went on 5
    ! expect: trap 3
    ! expect: handled
    ! expect: end
  ENDPROC
  TRAP t
    VAR num n := 7;
    TPWrite "trap " + ValToStr(p);
    IF p = 1 RETURN;
    IF p = 3 RAISE 5;
    TPWrite "endtrap";
  ERROR
    TPWrite "handled";
    RETURN;
  ENDTRAP
ENDMODULE
!=== wait_goes_on
MODULE wait_goes_on
! source: [mem] a wait that a trap interrupts goes on with its remaining time
  VAR intnum i;
  VAR clock c;
  PROC main()
    CONNECT i WITH short;
    ITimer \Single, 0.5, i;
    ClkStart c;
    WaitTime 2;
    ClkStop c;
    TPWrite NumToStr(ClkRead(c),1);
    ! expect: 2.0
  ENDPROC
  TRAP short
    WaitTime 0.5;
  ENDTRAP
ENDMODULE
!=== when_they_come
MODULE when_they_come
! source: [K §8.1] a trap comes 2 to 30 ms after its event
! expect: TRUE
! expect: TRUE
  VAR intnum i;
  PERS num p := 0;
  VAR clock c;
  VAR num least := 99;
  VAR num most := 0;
  TRAP t
    VAR num seconds;
    seconds := ClkRead(c \HighRes);
    IF seconds < least least := seconds;
    IF seconds > most most := seconds;
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    FOR k FROM 1 TO 100 DO
      ClkReset c;
      ClkStart c;
      p := p + 1;
      WaitTime 0.1;
      ClkStop c;
    ENDFOR
    TPWrite ValToStr(0.002 <= least AND least < 0.005);
    TPWrite ValToStr(0.025 < most AND most < 0.0305);
  ENDPROC
ENDMODULE
