MODULE interrupts_on_hold
    ! source: [S4 datasys 1-intnum-2] a queue holds 30
    ! case:
    ! do: set count 30, start, run 1.5
    ! state: running
    ! case:
    ! do: set count 31, start, run 1.5
    ! state: error
    ! fault: 40223 22
    VAR intnum i;
    PERS num p := 0;
    PERS num count := 0;
    TRAP t
    ENDTRAP
    PROC main()
        CONNECT i WITH t;
        IPers p, i;
        IDisable;
        FOR k FROM 1 TO count DO
            p := p + 1;
        ENDFOR
        WaitTime 1;
        IEnable;
        WaitTime 1;
    ENDPROC
ENDMODULE
