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
