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
