MODULE search_without_hit
    ! source: [S4 2-SearchL-5, "Instruction forward"] the program stops; no handler gets the error
    ! robot: irb120
    ! signal: sensor DI
    ! case:
    ! do: step
    ! do: step
    ! at: error
    ! fault: 49906 18
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
