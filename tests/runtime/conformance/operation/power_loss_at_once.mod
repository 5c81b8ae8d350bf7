MODULE power_loss_at_once
    ! source: [manual IPACV] power is lost before the first statement: SEMISTATIC begins, NORMAL waits for a start
    ! task: T_BACK back SEMISTATIC
    ! hook: on_start START T_ROB1
    ! hook: on_start START T_BACK
    ! do: start, power-loss, run 0.5
    ! expect: b main
    ! state: stopped running
    PROC on_start()
    ENDPROC
    PROC main()
        WaitTime 9;
    ENDPROC
    PROC back()
        TPWrite "b main";
        WaitTime 9;
    ENDPROC
ENDMODULE
