MODULE power_loss
    ! source: [manual IPACV] no STOP routine, POWER_ON when it is back; SEMISTATIC begins anew, NORMAL waits for a start
    ! task: T_BACK back SEMISTATIC
    ! hook: power_on POWER_ON T_ROB1
    ! hook: never STOP T_ROB1
    ! hook: back_power_on POWER_ON T_BACK
    ! hook: back_reset RESET T_BACK
    ! hook: back_start START T_BACK
    ! hook: never STOP T_BACK
    ! do: start, run 0.1
    ! expect: POWER_ON 12
    ! expect: main
    ! expect: b POWER_ON 12
    ! expect: b START 22
    ! expect: b main
    ! do: power-loss, run 0.5
    ! expect: POWER_ON 12
    ! expect: b POWER_ON 12
    ! expect: b RESET 62
    ! expect: b START 22
    ! expect: b main
    ! state: stopped running
    PROC power_on()
        tell "POWER_ON";
    ENDPROC
    PROC back_power_on()
        tell "b POWER_ON";
    ENDPROC
    PROC back_reset()
        tell "b RESET";
    ENDPROC
    PROC back_start()
        tell "b START";
    ENDPROC
    PROC never()
        tell "never";
    ENDPROC
    PROC tell(string event)
        TPWrite event + " " + ValToStr(EventType()) + ValToStr(ExecLevel());
    ENDPROC
    PROC main()
        TPWrite "main";
        WaitTime 100;
    ENDPROC
    PROC back()
        TPWrite "b main";
        WaitTime 100;
    ENDPROC
ENDMODULE
