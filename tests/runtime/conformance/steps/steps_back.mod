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
    ! log: 40700
    ! do: step back
    ! at: main n := 2;
    ! do: step back
    ! at: main n := 2;
    ! log: 40700 it stands at the top of a statement list
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
    ! log: 40700 plain has no BACKWARD handler
    ! value: args = 3
    ! do: step over, step over, step over
    ! expect: empty
    ! at: main TPWrite "end";
    ! do: step back
    ! at: main TPWrite "end";
    ! log: 40700 the statement before cannot be executed backward
    ! do: step
    ! expect: end
    ! do: step back
    ! at: main TPWrite "really";
    ! log: 40700 TPWrite is not executed backward
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
