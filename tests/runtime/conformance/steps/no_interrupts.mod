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
