!=== argument_error
MODULE argument_error
! source: 3HAC16581-1 has ERR_ARGVALERR [manual]; that a handler gets it [mem]
  PROC main()
    VAR num n;
    n := Sqrt(-1);
    ! expect: argument
    TPWrite "goes on";
    ! expect: goes on
  ERROR
    IF ERRNO = ERR_ARGVALERR TPWrite "argument";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== argument_fatal
MODULE argument_fatal
! source: [mem] the other answer: a refused argument stops the task; RAISE of that error does not
! dialect: argument_error=fatal
! fault: ERR_ARGVALERR 11
  PROC main()
    VAR num n;
    again;
    ! expect: raised
    TPWrite "goes on";
    ! expect: goes on
    n := Sqrt(-1);
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC again()
    RAISE ERR_ARGVALERR;
  ERROR
    TPWrite "raised";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== array_bounds
MODULE array_bounds
! source: [K §3.5, 12] indices from 1 to the size, whole; ERR_OUTOFBND
  VAR num a{3} := [1,2,3];
  VAR num m{2,2} := [[1,2],[3,4]];
  PROC main()
    VAR num b{3};
    b{0} := 1;
    b{4} := 1;
    b{-1} := 1;
    b{1.5} := 1;
    b{4 / 2} := 9;
    TPWrite ValToStr(b);
    b{1} := a{4};
    b{1} := m{2,3};
    b{1} := m{3,1};
    b{3} := m{2,1};
    TPWrite ValToStr(b);
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: [0,9,0]
    ! expect: bound
    ! expect: bound
    ! expect: bound
    ! expect: [0,9,3]
  ERROR
    IF ERRNO = ERR_OUTOFBND TPWrite "bound";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== errno_of_each_task
MODULE errno_of_each_task
! source: [K §13.2, 14.2] ERRNO is a task's own, and keeps its value behind the handler [code]
! task: T_BACK other
  PERS bool done := FALSE;
  PROC main()
    raises 5;
    WaitUntil done;
    TPWrite ValToStr(ERRNO);
    ! expect: 6
    ! expect: 5
  ENDPROC
  PROC other()
    WaitTime 0.01;
    raises 6;
    TPWrite ValToStr(ERRNO);
    done := TRUE;
  ENDPROC
  PROC raises(num n)
    RAISE n;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== error_in_handler
MODULE error_in_handler
! source: [K §7.1] an error inside a handler cannot be handled
! fault: ERR_OUTOFBND 17
  VAR num a{2};
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "first";
    ! expect: first
    a{3} := 1;
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== handler_end
MODULE handler_end
! source: [K §7.1] the end of a handler without RETRY, TRYNEXT, RETURN or RAISE: system error handler
! fault: ERR_DIVZERO 17
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    ! expect: handler
    divide;
  ENDPROC
  PROC divide()
    VAR num z;
    ! the error
    z := 1 / z;
  ERROR
    TPWrite "handler";
  ENDPROC
ENDMODULE
!=== handler_return
MODULE handler_return
! source: [K §4.7, 7.1] RETURN in a handler leaves the routine; a function gives its value
  PROC main()
    TPWrite ValToStr(safe(0)) + " " + ValToStr(safe(4));
    ! expect: -1 2.5
    leave;
    TPWrite "after";
    ! expect: after
  ENDPROC
  FUNC num safe(num d)
    RETURN 10 / d;
  ERROR
    RETURN -1;
  ENDFUNC
  PROC leave()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ERROR
    RETURN;
  ENDPROC
ENDMODULE
!=== listed
MODULE listed_shown
! source: [K §7.1] ERROR (list) takes only what it lists from its own body
  CONST errnum MINE := 7;
  PROC main()
    a 7;
    a 8;
    ! expect: a 7
    ! expect: main 8
  ERROR
    TPWrite "main " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC a(num n)
    RAISE n;
  ERROR (MINE, ERR_DIVZERO)
    TPWrite "a " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== long_jump
MODULE long_jump
! source: [K §7.2] a listed handler far up beats a plain ERROR nearer by; UNDO of what is dropped runs
  PROC main()
    TPWrite "start";
    far 7;
    TPWrite "between";
    far 8;
    TPWrite "end";
    ! expect: start
    ! expect: inner 7
    ! expect: undo middle
    ! expect: far 7
    ! expect: after the call
    ! expect: between
    ! expect: inner 8
    ! expect: plain 8
    ! expect: after inner
    ! expect: after the call
    ! expect: end
  ENDPROC
  PROC far(num n)
    middle n;
    TPWrite "after the call";
  ERROR (7)
    TPWrite "far " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC middle(num n)
    inner n;
    TPWrite "after inner";
  ERROR
    TPWrite "plain " + ValToStr(ERRNO);
    TRYNEXT;
  UNDO
    TPWrite "undo middle";
  ENDPROC
  PROC inner(num n)
    RAISE n;
  ERROR
    TPWrite "inner " + ValToStr(ERRNO);
    RAISE;
  ENDPROC
ENDMODULE
!=== long_jump_all
MODULE long_jump_all
! source: [K §7.2] LONG_JMP_ALL_ERR lists every error
  PROC main()
    middle;
    TPWrite "end";
    ! expect: main TRUE
    ! expect: end
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
!=== long_jump_of_bare
MODULE long_jump_of_bare
! source: [K §7.1, 7.2] an error in a routine without ERROR goes to the caller: first to the recovery
! point that lists it, however far; plain handlers between do not run, UNDO of what is dropped does
! dialect: unhandled_error=propagate
  PROC main()
    far 7;
    far 8;
    division;
    TPWrite "end";
    ! expect: undo inner
    ! expect: undo middle
    ! expect: far 7
    ! expect: after the call
    ! expect: plain 8
    ! expect: after inner
    ! expect: after the call
    ! expect: undo divide
    ! expect: far division
    ! expect: end
  ENDPROC
  PROC far(num n)
    middle n;
    TPWrite "after the call";
  ERROR (7)
    TPWrite "far " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC middle(num n)
    inner n;
    TPWrite "after inner";
  ERROR
    TPWrite "plain " + ValToStr(ERRNO);
    TRYNEXT;
  UNDO
    TPWrite "undo middle";
  ENDPROC
  PROC inner(num n)
    RAISE n;
  UNDO
    TPWrite "undo inner";
  ENDPROC
  PROC division()
    between;
  ERROR (ERR_DIVZERO)
    TPWrite "far division";
    TRYNEXT;
  ENDPROC
  PROC between()
    divide 0;
  ERROR
    TPWrite "plain division";
    TRYNEXT;
  ENDPROC
  PROC divide(num n)
    n := 1 / n;
  UNDO
    TPWrite "undo divide";
  ENDPROC
ENDMODULE
!=== long_jump_out_of_trap
MODULE long_jump_out_of_trap
! source: [K §7.2] a long jump may leave a trap: a listed handler below it takes the error, also
! when the trap came between two statements; TRYNEXT goes on there
  VAR intnum late;
  VAR num n := 0;
  VAR num sum := 0;
  PROC main()
    CONNECT late WITH on_late;
    ITimer \Single, 0.1, late;
    WHILE n < 30000 DO
      n := n + 1;
      sum := sum + 2;
    ENDWHILE
    TPWrite "whole: " + ValToStr(sum = 2 * n AND n = 30000);
    IDelete late;
    CONNECT late WITH on_late;
    ITimer \Single, 0.1, late;
    leave;
    TPWrite "main goes on";
    ! expect: trap
    ! expect: caught 7
    ! expect: whole: TRUE
    ! expect: trap
    ! expect: left
    ! expect: main goes on
  ERROR (7)
    TPWrite "caught " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC leave()
    WHILE TRUE DO
      n := n + 1;
    ENDWHILE
  ERROR (7)
    TPWrite "left";
    RETURN;
  ENDPROC
  TRAP on_late
    TPWrite "trap";
    bad;
  ERROR
    RAISE;
  ENDTRAP
  PROC bad()
    RAISE 7;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
!=== optional_absent
MODULE optional_absent
! source: [K §5.1, 11, 12] an absent optional parameter may not be read or set: ERR_NOTPRES
  PROC main()
    show \n:=3;
    show;
    pass \n:=4;
    pass;
    ! expect: 3
    ! expect: absent
    ! expect: NOTPRES
    ! expect: 4
    ! expect: absent
    ! expect: NOTPRES
    both;
    both \a:=1;
    both \b:="x";
    ! expect: FALSE FALSE
    ! expect: TRUE FALSE
    ! expect: FALSE TRUE
  ENDPROC
  PROC show(\num n)
    IF NOT Present(n) TPWrite "absent";
    TPWrite ValToStr(n + 0);
  ERROR
    IF ERRNO = ERR_NOTPRES TPWrite "NOTPRES";
    TRYNEXT;
  ENDPROC
  PROC pass(\num n)
    show \n?n;
  ENDPROC
  PROC both(\num a | string b)
    TPWrite ValToStr(Present(a)) + " " + ValToStr(Present(b));
  ENDPROC
ENDMODULE
!=== propagation
MODULE propagation
! source: [K §7.1, S4 overview 4-37] a routine without ERROR passes the error to its caller; TRYNEXT continues after the call
! dialect: unhandled_error=propagate
  PROC main()
    TPWrite "start";
    ! expect: start
    middle;
    TPWrite "after";
    ! expect: caught
    ! expect: after
  ERROR
    TPWrite "caught";
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
    TPWrite "never";
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ENDPROC
ENDMODULE
!=== raise_again
MODULE raise_again
! source: [K §4.8, 7.1] RAISE without a number gives the same error to the caller; ERRNO keeps its value
  PROC main()
    inner;
    TPWrite ValToStr(ERRNO = ERR_DIVZERO);
    ! expect: inner
    ! expect: main TRUE
    ! expect: TRUE
  ERROR
    TPWrite "main " + ValToStr(ERRNO = ERR_DIVZERO);
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "inner";
    RAISE;
  ENDPROC
ENDMODULE
!=== raise_in_handler
MODULE raise_in_handler
! source: public modules that run on controllers (ABB's StateMachine add-in, Keyence's CV-X) raise a
! number in a handler [code]; [K §4.8] forbids it: a switch
  CONST errnum other := 7;
  PROC main()
    middle;
    TPWrite "next";
    ! expect: inner
    ! expect: middle got 7
    ! expect: main got 8
    ! expect: next
    far;
    TPWrite "end";
    ! expect: point got 9
    ! expect: end
  ERROR
    TPWrite "main got " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC middle()
    inner;
  ERROR
    TPWrite "middle got " + ValToStr(ERRNO);
    RAISE 8;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ERROR
    TPWrite "inner";
    RAISE other;
  ENDPROC
  PROC far()
    between;
  ERROR (9)
    TPWrite "point got " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC between()
    VAR num z;
    thrower;
  ERROR
    TPWrite "never: the long jump passes it";
    RAISE;
  ENDPROC
  PROC thrower()
    VAR num z;
    z := 1 / z;
  ERROR
    IF ERRNO = ERR_DIVZERO RAISE 9;
    RAISE;
  ENDPROC
ENDMODULE
!=== raise_in_handler_error
MODULE raise_in_handler_error
! source: [K §4.8] RAISE with a number must not stand in an error handler
! dialect: raise_in_handler=error
! fault: 194001 12
  PROC main()
    VAR num z;
    z := 1 / z;
    TPWrite "never";
  ERROR
    TPWrite "handler";
    ! expect: handler
    RAISE 8;
  ENDPROC
ENDMODULE
!=== raise_number
MODULE raise_number
! source: [K §4.8] RAISE takes 1 to 90 or a booked number; anything else is ERR_ILLRAISE
  VAR errnum mine := -1;
  VAR errnum other := -1;
  PROC main()
    BookErrNo mine;
    BookErrNo other;
    TPWrite ValToStr(mine <> other) + " " + ValToStr(mine > 90);
    ! expect: TRUE TRUE
    RAISE 90;
    RAISE mine;
    RAISE 91;
    RAISE 0;
    RAISE 1.5;
    RAISE ERR_ARGVALERR;
    ! expect: 90
    ! expect: mine
    ! expect: illegal
    ! expect: illegal
    ! expect: illegal
    ! expect: argval
  ERROR
    IF ERRNO = 90 TPWrite "90";
    IF ERRNO = mine TPWrite "mine";
    IF ERRNO = ERR_ILLRAISE TPWrite "illegal";
    IF ERRNO = ERR_ARGVALERR TPWrite "argval";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== raise_to_user_break_off
MODULE user
! source: [K §7.3] \BreakOff drops the routines between, whose UNDO runs; RETRY calls them anew
  VAR num calls := 0;
  PROC main()
    outer;
    TPWrite "end";
    ! expect: inner 1
    ! expect: undo
    ! expect: user 5
    ! expect: inner 2
    ! expect: undo
    ! expect: user 5
    ! expect: next
    ! expect: returned to the caller
    ! expect: undo
    ! expect: raised 7
    ! expect: end
  ENDPROC
  PROC outer()
    middle;
    TPWrite "next";
    returns;
    TPWrite "returned to the caller";
    raises;
  ERROR
    IF ERRNO = 7 THEN
      TPWrite "raised 7";
      TRYNEXT;
    ENDIF
    TPWrite "user " + ValToStr(ERRNO);
    IF calls = 1 RETRY;
    TRYNEXT;
  ENDPROC
  PROC returns()
    last;
    TPWrite "never here";
  ERROR
    RETURN;
  ENDPROC
  PROC raises()
    VAR num z;
    middle;
  ERROR
    RAISE 7;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  PROC middle()
    inner;
  ERROR
    TPWrite "never here either";
    TRYNEXT;
  UNDO
    TPWrite "undo";
  ENDPROC
  PROC inner()
    calls := calls + 1;
    IF calls < 3 TPWrite "inner " + ValToStr(calls);
    RAISE 5;
  ERROR
    RaiseToUser \BreakOff;
  ENDPROC
  PROC last()
    RAISE 6;
  ERROR
    RaiseToUser \Continue;
  ENDPROC
ENDMODULE
!=== raise_to_user_continue
MODULE user
! source: [K §7.3] RETRY and TRYNEXT of the user's handler go on where the error occurred
! dialect: unhandled_error=propagate
  VAR num tries := 0;
  PROC main()
    routine1;
    TPWrite "end";
    ! expect: routine2
    ! expect: routine3
    ! expect: user 11
    ! expect: user 11
    ! expect: divided
    ! expect: user 2
    ! expect: passed over
    ! expect: back in routine2
    ! expect: end
  ENDPROC
  PROC routine1()
    routine2;
  ERROR
    IF ERRNO = 11 OR ERRNO = 2 THEN
      TPWrite "user " + ValToStr(ERRNO);
    ELSE
      TPWrite "what?";
    ENDIF
    Incr tries;
    divisor := tries - 1;
    IF ERRNO = 11 RETRY;
    TRYNEXT;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  VAR num divisor := 0;
  PROC routine2()
    TPWrite "routine2";
    routine3;
    TPWrite "back in routine2";
  ERROR
    TPWrite "never here";
    TRYNEXT;
  ENDPROC
  PROC routine3()
    VAR num q;
    TPWrite "routine3";
    q := 1 / divisor;
    TPWrite "divided";
    helper;
    TPWrite "passed over";
  ERROR
    IF ERRNO = ERR_DIVZERO RaiseToUser \Continue \ErrorNumber:=11;
    RaiseToUser \Continue;
    TPWrite "never here either";
    TRYNEXT;
  ENDPROC
  PROC helper()
    RAISE 2;
  ENDPROC
ENDMODULE
!=== raise_to_user_limit
MODULE user
! source: [K §7.3, 7.5] a statement has its retries, for every RETRY
! fault: ERR_EXCRTYMAX 28
  PROC main()
    fails;
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: user
    ! expect: 55
    ! expect: user
  ERROR
    TPWrite "user";
    RETRY;
  ENDPROC
ENDMODULE
MODULE hidden(NOSTEPIN)
  PROC fails()
    VAR num z;
    WHILE TRUE DO
      z := z + 1;
      IF z = 2 RETURN;
      TPRead;
    ENDWHILE
  ENDPROC
  PROC TPRead()
    RAISE 5;
  ERROR
    IF ERRNO <> 5 TPWrite "55";
    RaiseToUser \Continue;
  ENDPROC
ENDMODULE
!=== reset_retry_count
MODULE reset_retry_count
! source: [manual DB] ResetRetryCount
  VAR num tries := 0;
  PROC main()
    VAR num z;
    z := 10 / z;
    TPWrite ValToStr(tries) + " " + ValToStr(z);
    ! expect: 9 10
  ERROR
    Incr tries;
    IF tries = 4 ResetRetryCount;
    IF tries >= 9 z := 1;
    IF tries = 8 ResetRetryCount;
    RETRY;
  ENDPROC
ENDMODULE
!=== retry
MODULE retry_shown
! source: [K §4.10, 7.1] RETRY repeats the failing statement, and only that
  PROC main()
    VAR num d := 0;
    VAR num before := 0;
    VAR num q;
    Incr before;
    q := 10 / d;
    TPWrite ValToStr(q) + " " + ValToStr(before);
    ! expect: 5 1
  ERROR
    d := d + 2;
    RETRY;
  ENDPROC
ENDMODULE
!=== retry_exhausted
MODULE retry_exhausted
! source: [K §7.5] retries used up and RETRY again: the task stops
! fault: ERR_EXCRTYMAX 8
  VAR num seen := 0;
  PROC main()
    VAR num z;
    TPWrite "start";
    z := 1 / z;
    ! expect: start
    ! expect: 6
  ERROR
    Incr seen;
    IF seen = 6 TPWrite ValToStr(seen);
    RETRY;
  ENDPROC
ENDMODULE
!=== retry_limit
MODULE retry_limit
! source: [K §7.5] four retries; [S4 datasys 2-IODisable-2] the handler may then see ERR_EXCRTYMAX
  VAR num tries := 0;
  PROC main()
    VAR num q;
    q := divide(0);
    TPWrite ValToStr(q) + " after " + ValToStr(tries);
    ! expect: -1 after 5
    forever;
    ! expect: 4 3 2 1 0
  ENDPROC
  FUNC num divide(num d)
    Incr tries;
    Decr tries;
    RETURN count() / d;
  ERROR
    IF ERRNO = ERR_EXCRTYMAX RETURN -1;
    RETRY;
  ENDFUNC
  FUNC num count()
    Incr tries;
    RETURN 1;
  ENDFUNC
  PROC forever()
    VAR num z;
    VAR string left;
    z := 1 / z;
  ERROR
    left := left + ValToStr(RemainingRetries());
    IF RemainingRetries() > 0 THEN
      left := left + " ";
      RETRY;
    ENDIF
    TPWrite left;
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== retry_raised
MODULE retry_raised
! source: [S4 datasys 2-RETRY-1] switch retry_raised=false: RETRY is not for an error made by RAISE
! dialect: retry_raised=false
! fault: 194199 14
  VAR num n := 0;
  PROC main()
    once;
    TPWrite "never";
    ! expect: handler
  ENDPROC
  PROC once()
    VAR num k;
    n := n + 1;
    RAISE 5;
  ERROR
    TPWrite "handler";
    RETRY;
  ENDPROC
ENDMODULE
!=== stop_switch
MODULE stop_switch
! source: logs of controllers (RobotWare 6.03, 6.15) and ABB's modules for RobotWare 7: the system error handler takes over at once
! fault: ERR_DIVZERO 12
  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC inner()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
!=== trynext
MODULE trynext_shown
! source: [K §4.11, 7.2] TRYNEXT skips the failing statement; an error in a condition skips the compound
  PROC main()
    VAR num z := 0;
    VAR num n := 1;
    n := 1 / z;
    TPWrite "n " + ValToStr(n);
    ! expect: n 1
    IF 1 / z > 0 THEN
      TPWrite "never";
    ELSE
      TPWrite "never";
    ENDIF
    WHILE 1 / z > 0 DO
      TPWrite "never";
    ENDWHILE
    FOR i FROM 1 TO 1 / z DO
      TPWrite "never";
    ENDFOR
    TEST 1 / z
    CASE 1:
      TPWrite "never";
    DEFAULT:
      TPWrite "never";
    ENDTEST
    WHILE n < 3 DO
      Incr n;
      z := 1 / 0;
      TPWrite "pass " + ValToStr(n);
    ENDWHILE
    ! expect: pass 2
    ! expect: pass 3
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== undo
MODULE undo_shown
! source: [K §7.2-7.4] UNDO when the routine is aborted, not at a normal RETURN nor when a caller handles the error
! dialect: unhandled_error=propagate
! cycle: 6
  VAR num round := 0;
  PROC main()
    Incr round;
    work round;
    TPWrite "returned " + ValToStr(round);
    ! expect: returned 1
    ! expect: handled
    ! expect: returned 2
    ! expect: undo 3
    ! expect: undo 4
    IF round = 3 EXIT;
  ERROR
    TPWrite "handled";
    TRYNEXT;
  ENDPROC
  PROC work(num n)
    IF n = 2 RAISE 5;
    IF n = 3 ExitCycle;
    IF n = 4 EXIT;
    RETURN;
  UNDO
    TPWrite "undo " + ValToStr(n);
  ENDPROC
ENDMODULE
!=== undo_fails
MODULE undo_fails
! source: [mem] an error in UNDO stops the task; the other UNDO handlers are left out
! fault: ERR_DIVZERO 27
  PROC main()
    outer;
    ! expect: inner
    ! expect: undo of inner
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC outer()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC
  PROC inner()
    VAR num z;
    TPWrite "inner";
    ExitCycle;
  UNDO
    TPWrite "undo of inner";
    fails;
  ENDPROC
  PROC fails()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
!=== undo_ignored
MODULE undo_ignored
! source: [mem] the other answer: an error in UNDO ends that handler only
! dialect: undo_error=ignore
  PROC main()
    VAR num z;
    outer;
    TPWrite "never";
    ! expect: inner
    ! expect: undo of inner
    ! expect: undo of outer
  ENDPROC
  PROC outer()
    inner;
  UNDO
    TPWrite "undo of outer";
  ENDPROC
  PROC inner()
    TPWrite "inner";
    ExitCycle;
  UNDO
    TPWrite "undo of inner";
    fails;
    TPWrite "never";
  ENDPROC
  PROC fails()
    VAR num z;
    z := 1 / z;
  ENDPROC
ENDMODULE
!=== unhandled_undo
MODULE unhandled_undo
! source: [mem] an unhandled error that leaves the routine runs UNDO
! dialect: after_error=main
! fault: ERR_DIVZERO 12
  PROC main()
    work;
  ENDPROC
  PROC work()
    VAR num z;
    ! expect: undo
    !
    z := 1 / z;
  UNDO
    TPWrite "undo";
  ENDPROC
ENDMODULE
!=== unknown_function
MODULE unknown_function
! source: [K §12] ERR_REFUNKFUN: reached, not linked; motion_program_exec [code] calls what another
! module may bring, as a bool, a string and a record
  PROC main()
    VAR string s;
    VAR pos p;
    IF FALSE THEN
      s := nowhere_string();
      p := nowhere_pos(1);
    ENDIF
    TPWrite "before";
    ! expect: before
    IF nowhere_bool(s) TPWrite "never";
    TPWrite "after";
    ! expect: unknown
    ! expect: after
    RETURN;
  ERROR
    IF ERRNO = ERR_REFUNKFUN TPWrite "unknown";
    TRYNEXT;
  ENDPROC
ENDMODULE
!=== while_condition
MODULE while_condition
! source: [K §7.2] TRYNEXT after an error in a condition skips the whole of the compound statement
  VAR num n := 0;
  PROC main()
    WHILE fine("while") DO
      TPWrite "pass";
    ENDWHILE
    TPWrite "behind while";
    n := 0;
    IF fine("if") THEN
      TPWrite "then";
    ELSE
      TPWrite "never";
    ENDIF
    IF fine("if") THEN
      TPWrite "never";
    ELSE
      TPWrite "never";
    ENDIF
    TPWrite "behind if";
    ! expect: pass
    ! expect: failed in while
    ! expect: behind while
    ! expect: then
    ! expect: failed in if
    ! expect: behind if
  ERROR
    TRYNEXT;
  ENDPROC
  FUNC bool fine(string where)
    n := n + 1;
    IF n = 2 THEN
      TPWrite "failed in " + where;
      RAISE 5;
    ENDIF
    RETURN TRUE;
  ERROR
    RAISE;
  ENDFUNC
ENDMODULE
