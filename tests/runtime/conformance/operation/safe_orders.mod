MODULE safe_orders
    ! source: [S4 overview 4-39] an order is lost while the program stands; RobotWare manuals: \SingleSafe waits
    ! do: start, run 1, stop, run 1, set single 1, set safe 1, run 1
    ! do: start, run 1
    ! expect: safe
    VAR intnum i;
    VAR intnum j;
    PERS num single := 0;
    PERS num safe := 0;
    TRAP lost
        TPWrite "single";
    ENDTRAP
    TRAP kept
        TPWrite "safe";
    ENDTRAP
    PROC main()
        CONNECT i WITH lost;
        CONNECT j WITH kept;
        IPers \Single, single, i;
        IPers \SingleSafe, safe, j;
        WaitTime 5;
    ENDPROC
ENDMODULE
