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
