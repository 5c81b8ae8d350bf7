!=== calls_go_on
MODULE calls_go_on
    ! source: [S4 overview 3-23] a call that is not made again changes no other; late bound calls and recursion go on
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: first
    ! expect: second
    ! do: set bad 1, run 1
    ! expect: inner
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 5
    ! expect: main
    ! do: set bad 1, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 10
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        IF bad > 0 inner "first";
        inner "second";
        WaitTime 1.5;
        %"late"% 5;
        TPWrite "main";
        WaitTime 1.5;
        TPWrite ValToStr(sum(4));
    ENDPROC
    PROC inner(string s)
        fails;
        TPWrite s;
    ENDPROC
    PROC late(num n)
        TPWrite "inner";
        fails;
        TPWrite ValToStr(n);
    ENDPROC
    FUNC num sum(num n)
        IF n = 0 RETURN value(0);
        RETURN n + sum(n - 1);
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== failing_store
MODULE failing_store
    ! source: [S4 overview 3-23] a store that fails leaves its target
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 3E+38
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num x := 3E38;
        VAR num y := 2;
        IF bad = 0 y := 1;
        x := x * y * (2 - (1 * factor()));
        TPWrite ValToStr(x);
    ENDPROC
    FUNC num factor()
        IF bad > 0 RETURN 0;
        RETURN 1.5;
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== from_main_goto
MODULE from_main_goto
    ! source: [S4 overview 3-23] [mem] where GOTO may lead, it starts from main only
    ! do: start, run 2
    ! state: error
    ! do: set bad 0, start, run 2
    ! state: error
    ! log: 194001 a routine with GOTO cannot go on in the middle: PP to main; 194001 a routine with GOTO cannot go on in the middle: PP to main
    ! do: pp-to-main, start, run 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num n;
        again:
        fails;
        IF n > 1 GOTO again;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== from_main_handler
MODULE from_main_handler
    ! source: [S4 overview 3-23] [mem] in a handler, it starts from main only
    ! dialect: unhandled_error=propagate
    ! do: start, run 2
    ! state: error
    ! do: set bad 0, start, run 2
    ! state: error
    ! log: 10097 Task T_ROB1 is blocked and cannot continue from where it stands.
    ! do: pp-to-main, start, run 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        fails;
    ERROR
        fails;
        TRYNEXT;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== from_main_trap
MODULE from_main_trap
    ! source: [S4 overview 3-23] [mem] in a trap, it starts from main only
    ! do: start, run 2
    ! state: error
    ! do: set bad 0, start, run 2
    ! state: error
    ! log: 10097 Task T_ROB1 is blocked and cannot continue from where it stands.
    ! do: pp-to-main, start, run 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    VAR intnum i;
    TRAP t
        fails;
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        ITimer 0.1, i;
        WaitTime 1;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== interrupts_stay
MODULE interrupts_stay
    ! source: [S4 overview 3-23] [S4 overview 4-24] interrupts stay ordered; [4-39] what happens while it stands is lost
    ! do: start, run 1, set p 1, set bad 0, start, run 2
    ! expect: trap 2
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    VAR intnum i;
    PERS num p := 0;
    TRAP t
        TPWrite "trap " + ValToStr(p);
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        fails;
        p := 2;
        WaitTime 1;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== loops_go_on
MODULE loops_go_on
    ! source: [S4 overview 3-23] loops go on behind the pass
    ! do: start, run 1
    ! expect: 13
    ! expect: 12
    ! expect: 11
    ! expect: i
    ! expect: 23
    ! state: error
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 22
    ! expect: 21
    ! expect: i
    ! expect: 33
    ! expect: 32
    ! expect: 31
    ! expect: i
    ! expect: w1
    ! expect: w2
    ! expect: end
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num w := 0;
        FOR i FROM 1 TO 3 DO
            FOR j FROM 3 TO 1 STEP -1 DO
                IF i = 2 AND j = 2 fails;
                TPWrite ValToStr(i) + ValToStr(j);
            ENDFOR
            TPWrite "i";
        ENDFOR
        FOR i FROM 0.5 TO 2 DO
            WHILE w < i DO
                w := w + 1;
                IF i = 1.5 fails;
                TPWrite "w" + ValToStr(w);
            ENDWHILE
        ENDFOR
        TPWrite "end";
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== main_only
MODULE main_only
    ! source: [S4 overview 3-23] [mem] the other behaviour: after an error it starts from main only
    ! dialect: after_error=main
    ! do: start, run 1
    ! log: 194199 main_only/fails/18; 194199 main_only/fails/18
    ! do: set bad 0, start, run 1
    ! log: 194199
    ! state: error
    ! fault: ERR_OUTOFBND 18
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        fails;
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== moves_go_on
MODULE moves_go_on
    ! source: [S4 overview 3-23] moves behind the statement are made
    ! robot: irb120
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 9
    ! expect: 20
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    CONST jointtarget there := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        VAR jointtarget here;
        fails;
        MoveAbsJ there, v1000, fine, tool0;
        here := CJointT();
        TPWrite ValToStr(Round(here.robax.rax_1 \Dec:=3));
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== stack_goes_on
MODULE stack_goes_on
    ! source: [S4 overview 3-23] every routine of the stack goes on
    ! dialect: unhandled_error=propagate
    ! do: start, run 1
    ! expect: twice
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: value 22
    ! expect: middle 10
    ! expect: main 110
    ! expect: twice
    ! expect: value 42
    ! expect: middle 20
    ! expect: main 220
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num r;
        FOR i FROM 1 TO 2 DO
            middle i, \back:=r;
            TPWrite "main " + ValToStr(i) + ValToStr(r);
        ENDFOR
    ENDPROC
    PROC middle(num a, \INOUT num back)
        VAR num k;
        k := a * 10;
        TPWrite "value " + ValToStr(1 + twice(k) + 1);
        back := k;
        TPWrite "middle " + ValToStr(k);
    ERROR
        RAISE;
    ENDPROC
    FUNC num twice(num v)
        VAR num own;
        own := v;
        TPWrite "twice";
        own := value(own) + own;
        RETURN own;
    ENDFUNC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== tried_again
MODULE tried_again
    ! source: [S4 overview 3-23] the faulty statement is tried again, variables are kept
    ! case:
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 67894
    ! state: finished
    ! case:
    ! do: set bad 3, start, run 1, set bad 2, start, run 1, set bad 1, start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 67894
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    VAR num global := 1;
    PROC main()
        VAR num n := 5;
        VAR pos p := [1,2,3];
        VAR num list{3} := [1,2,3];
        CONST num c := 4;
        n := 6;
        p.x := 7;
        list{2} := 8;
        global := 9;
        fails;
        TPWrite ValToStr(n) + ValToStr(p.x) + ValToStr(list{2}) + ValToStr(global) + ValToStr(c);
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
!=== undo_waits
MODULE undo_waits
    ! source: [S4 overview 3-23] [K §7.4] UNDO runs when a routine is aborted: not at the error, but when the pointer is moved
    ! case:
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: inner
    ! expect: outer
    ! state: finished
    ! case:
    ! do: start, run 1
    ! do: pp-to-main, run 1
    ! expect: undo inner 3
    ! expect: undo outer
    ! state: ready
    ! do: set bad 0, start, run 1
    ! expect: inner
    ! expect: outer
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        outer;
    ENDPROC
    PROC outer()
        inner;
        TPWrite "outer";
    UNDO
        TPWrite "undo outer";
    ENDPROC
    PROC inner()
        VAR num n := 3;
        fails;
        TPWrite "inner";
    UNDO
        TPWrite "undo inner " + ValToStr(n);
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
