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
