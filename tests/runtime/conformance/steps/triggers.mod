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
