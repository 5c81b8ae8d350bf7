!=== behind_an_error
MODULE behind_an_error
    ! source: [S4 overview 3-23] a step tries the faulty statement again; a step back goes before it
    ! do: step
    ! do: step
    ! at: error
    ! do: step back
    ! at: main n := 5;
    ! do: set z 2, step
    ! at: main n := n / z;
    ! do: step
    ! at: main TPWrite ValToStr(n);
    ! do: step
    ! expect: 2.5
    ! at: finished
    PERS num z := 0;
    PROC main()
        VAR num n;
        n := 5;
        n := n / z;
        TPWrite ValToStr(n);
    ENDPROC
ENDMODULE
!=== error_in_backward_handler
MODULE error_in_backward_handler
    ! source: [K §7.1] no handler receives it
    ! do: step over
    ! expect: work
    ! do: step back
    ! at: error
    ! do: start, run 1
    ! expect: next
    PROC main()
        work;
        TPWrite "next";
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC
    PROC work()
        TPWrite "work";
    BACKWARD
        RAISE 7;
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== forward
MODULE forward
    ! source: [K §6, S4 overview 4-39] statement by statement; over a call; a start goes on behind; a wait begins anew
    ! case:
    ! do: step
    ! at: main FOR i FROM 1 TO 2 DO
    ! do: step
    ! at: main n := n + i;
    ! do: step
    ! at: main IF n > 3 THEN
    ! do: step
    ! at: main n := n + i;
    ! do: step
    ! at: main IF n > 3 THEN
    ! do: step
    ! at: main TPWrite "more";
    ! do: step
    ! expect: more
    ! at: main inner n;
    ! do: step
    ! at: inner TPWrite "inner";
    ! do: step
    ! expect: inner
    ! at: inner WaitTime 1;
    ! do: step
    ! at: main TPWrite ValToStr(n);
    ! do: step
    ! expect: 4
    ! at: finished
    ! do: step
    ! at: main FOR i FROM 1 TO 2 DO
    ! do: step
    ! at: main n := n + i;
    ! case:
    ! do: step over, step over, step over, step over, step over, step over
    ! at: main TPWrite "more";
    ! do: step over
    ! expect: more
    ! at: main inner n;
    ! do: step over
    ! expect: inner
    ! at: main TPWrite ValToStr(n);
    ! do: step over
    ! expect: 4
    ! at: finished
    ! case:
    ! do: start, run 0.5, step
    ! refused: step
    ! expect: more
    ! expect: inner
    ! do: stop, run 0.1
    ! at: inner WaitTime 1;
    ! do: step
    ! at: main TPWrite ValToStr(n);
    ! do: step
    ! expect: 4
    ! at: finished
    ! case:
    ! do: step, step, step, step, start, run 3
    ! expect: more
    ! expect: inner
    ! expect: 4
    ! state: finished
    PROC main()
        VAR num n;
        n := 1;
        FOR i FROM 1 TO 2 DO
            n := n + i;
            IF n > 3 THEN
                TPWrite "more";
            ENDIF
        ENDFOR
        inner n;
        TPWrite ValToStr(n);
    ENDPROC
    PROC inner(num a)
        TPWrite "inner";
        WaitTime 1;
    ENDPROC
ENDMODULE
!=== moves_back
MODULE moves_back
    ! source: [S4 2-SearchL-6] backward a move carries out the movement: only one that was stepped, from where it ended
    ! robot: irb120
    ! signal: lamp DO
    ! case:
    ! do: start, run 4.5, stop, run 2
    ! at: main WaitTime 9;
    ! do: service look, run 0.5
    ! expect: [314.354,0,544]
    ! do: step back
    ! at: main WaitTime 9;
    ! log: 10128 MoveJ: its start is unknown, or the robot is not at its end
    ! do: service look, run 0.5
    ! expect: [314.354,0,544]
    ! case:
    ! do: step, step, jog 0.01
    ! do: service look, run 0.5
    ! expect: [366.038,104.654,585.889]
    ! do: step back
    ! at: main MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
    ! log: 10128 MoveLDO: its start is unknown, or the robot is not at its end
    ! do: service look, run 0.5
    ! expect: [366.038,104.654,585.889]
    ! case: moves_back=false
    ! do: step, step, service look, run 0.5
    ! expect: [364.354,100,594]
    ! do: step back
    ! at: main MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
    ! log: 10128 MoveLDO is not executed backward
    ! do: service look, run 0.5
    ! expect: [364.354,100,594]
    ! case:
    ! [S4 2-TriggL] "no trigger activities at all are carried out"
    ! do: step, step
    ! value: lamp = 1
    ! do: signal lamp 0, step back
    ! at: main MoveLDO Offs(a, 0, 100, 0), v500, z20, tool0, lamp, 1;
    ! value: lamp = 0
    CONST robtarget a := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveAbsJ home, v1000, z50, tool0;
        MoveLDO Offs(a, 0, 100, 0), v500, z20, tool0, lamp, 1;
        MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
        MoveJ Offs(a, -50, 0, -50), v1000, z50, tool0;
        WaitTime 9;
    ENDPROC
    PROC look()
        VAR pos here;
        here := CPos(\Tool:=tool0);
        here := [Round(here.x \Dec:=3),Round(here.y \Dec:=3),Round(here.z \Dec:=3)];
        TPWrite ValToStr(here);
    ENDPROC
ENDMODULE
!=== moves_end
MODULE moves_end
    ! source: [mem] each step is a stop point: a move ends before the step does
    ! robot: irb120
    ! do: step
    ! at: main MoveAbsJ b, v1000, z50, tool0;
    ! do: service look, run 0.1
    ! expect: 20
    ! do: run 1, service look, run 0.1
    ! expect: 20
    ! do: step, run 3, service look, run 0.1
    ! expect: 0
    CONST jointtarget a := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget b := [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveAbsJ a, v1000, z50, tool0;
        MoveAbsJ b, v1000, z50, tool0;
    ENDPROC
    PROC look()
        VAR jointtarget here;
        here := CJointT();
        TPWrite ValToStr(Round(here.robax.rax_1 \Dec:=2));
    ENDPROC
ENDMODULE
!=== no_interrupts
MODULE no_interrupts
    ! source: [S4 overview 4-39] interrupts are lost in a step
    ! do: step, step, step, step
    ! do: start, run 3
    ! expect: trap
    VAR intnum i;
    PERS num p := 0;
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        p := 1;
        WaitTime 1;
        p := 2;
        WaitTime 1;
    ENDPROC
ENDMODULE
!=== no_interrupts_back
MODULE no_interrupts_back
    ! source: [S4 overview 4-39] interrupts are lost in a step, whichever way it goes
    ! do: step over, step over, step over, step over
    ! expect: forward
    ! at: main WaitTime 1;
    ! do: step back
    ! expect: back
    ! at: main count;
    ! value: p = 3
    ! do: start, run 3
    ! expect: forward
    ! expect: trap
    VAR intnum i;
    PERS num p := 0;
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        TPErase;
        count;
        WaitTime 1;
    ENDPROC
    PROC count()
        p := 2;
        TPWrite "forward";
    BACKWARD
        p := 3;
        TPWrite "back";
    ENDPROC
ENDMODULE
!=== nostepin
MODULE helpers(NOSTEPIN)
    ! source: [S4 overview 4-8, K §9.1] such a module runs as a whole, but for what it calls elsewhere
    ! do: step
    ! expect: 1
    ! at: back TPWrite "b";
    ! do: step
    ! expect: b
    ! expect: 2
    ! at: main TPWrite "3";
    ! do: step
    ! expect: 3
    ! at: finished
    PROC helper()
        TPWrite "1";
        back;
        TPWrite "2";
    ENDPROC
ENDMODULE
MODULE user
  PROC main()
    helper;
    TPWrite "3";
  ENDPROC
  PROC back()
    TPWrite "b";
  ENDPROC
ENDMODULE
!=== refused
MODULE refused
    ! source: [mem] no step in an emergency stop, back from nowhere, or in a handler
    ! do: e-stop, step
    ! refused: step
    ! do: reset-e-stop, motors-on, step back
    ! refused: step back
    ! do: start, run 1, stop, run 1, step
    ! refused: step
    ! do: start, run 9
    ! state: finished
    PROC main()
        RAISE 5;
    ERROR
        WaitTime 5;
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== search_without_hit
MODULE search_without_hit
    ! source: [S4 2-SearchL-5, "Instruction forward"] the program stops; no handler gets the error
    ! robot: irb120
    ! signal: sensor DI
    ! case:
    ! do: step
    ! do: step
    ! at: error
    ! fault: 194906 18
    ! case:
    ! do: start, run 9
    ! expect: handled
    CONST robtarget a := [[350,0,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget b := [[350,50,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR robtarget found;
    PROC main()
        MoveJ a, v1000, fine, tool0;
        SearchL \Stop, sensor, found, b, v200, tool0;
    ERROR
        TPWrite "handled";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== step_event
MODULE step_event
    ! source: [DB] EventType of STEP; its routine runs at each step
    ! hook: on_step STEP T_ROB1
    ! do: step, step, step
    ! expect: 7
    ! expect: 7
    ! expect: 7
    PROC on_step()
        TPWrite ValToStr(EventType());
    ENDPROC
    PROC main()
        VAR num n;
        n := 1;
        n := 2;
        n := 3;
    ENDPROC
ENDMODULE
!=== steps_back
MODULE steps_back
    ! source: [K §6] assignments, CONNECT: nothing; a call: its handler, its arguments evaluated; not out of a list
    ! case:
    ! do: step over, step over, step over, step over
    ! expect: does
    ! expect: empty
    ! at: main plain value(5);
    ! value: g = 2
    ! do: step back
    ! at: main empty;
    ! do: step back
    ! expect: does back 10
    ! at: main does value(n), g;
    ! value: g = 0
    ! value: args = 2
    ! do: step back
    ! at: main CONNECT i WITH t;
    ! log: 10128
    ! do: step back
    ! at: main n := 2;
    ! do: step back
    ! at: main n := 2;
    ! log: 10128 the program is at the top of a statement list
    ! CONNECT was executed before: it is not undone by going back.
    ! do: step
    ! at: main CONNECT i WITH t;
    ! case:
    ! do: step over, step over, step over, step over, step over
    ! expect: does
    ! expect: empty
    ! expect: plain
    ! at: main IF n = 2 THEN
    ! value: args = 2
    ! do: step back
    ! at: main IF n = 2 THEN
    ! log: 10128 plain has no BACKWARD handler
    ! value: args = 3
    ! do: step over, step over, step over
    ! expect: empty
    ! at: main TPWrite "end";
    ! do: step back
    ! at: main TPWrite "end";
    ! log: 10128 the statement before cannot be executed backward
    ! do: step
    ! expect: end
    ! do: step back
    ! at: main TPWrite "really";
    ! log: 10128 TPWrite is not executed backward
    ! do: step
    ! expect: really
    ! at: finished
    ! case:
    ! do: step over, step over, step over, step over, step over, step over, step over
    ! expect: does
    ! expect: empty
    ! expect: plain
    ! at: main empty; ! inside
    ! do: step back
    ! at: main n := 3;
    ! do: step back
    ! at: main n := 3;
    ! do: step
    ! at: main empty; ! inside
    VAR num g := 0;
    VAR num args := 0;
    VAR intnum i;
    TRAP t
    ENDTRAP
    PROC main()
        VAR num n := 1;
        n := 2;
        CONNECT i WITH t;
        does value(n), g;
        empty;
        plain value(5);
        IF n = 2 THEN
            n := 3;
            empty; ! inside
        ENDIF
        TPWrite "end";
        TPWrite "really";
    ENDPROC
    FUNC num value(num v)
        args := args + 1;
        RETURN v;
    ENDFUNC
    PROC does(num a, INOUT num b)
        VAR num k := 10;
        b := b + a;
        TPWrite "does";
    BACKWARD
        TPWrite "does back " + ValToStr(k);
        b := b - a;
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC
    PROC empty()
        TPWrite "empty";
    BACKWARD
    ENDPROC
    PROC plain(num a)
        TPWrite "plain";
    ENDPROC
ENDMODULE
!=== triggers
MODULE triggers
    ! source: [S4 2-TriggL-3] in a step a trigger sets its signal and runs no trap
    ! robot: irb120
    ! signal: lamp DO
    ! case:
    ! do: step, step, step, step
    ! value: lamp = 0
    ! do: step
    ! at: main WaitTime 1;
    ! value: lamp = 1
    ! case:
    ! do: start, run 9
    ! expect: trap
    ! value: lamp = 1
    CONST robtarget a := [[350,0,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget b := [[350,150,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR triggdata io;
    VAR triggdata int;
    VAR intnum i;
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        TriggInt int, 50, i;
        TriggIO io, 50 \DOp:=lamp, 1;
        MoveJ a, v1000, fine, tool0;
        TriggL b, v200, io \T2:=int, fine, tool0;
        WaitTime 1;
    ENDPROC
ENDMODULE
