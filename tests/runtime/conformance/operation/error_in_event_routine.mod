MODULE error_in_event_routine
    ! source: [K §7.2] levels are left by long jumps only: an error there is not for the handlers of the program
    ! hook: stopped STOP T_ROB1
    ! fault: error 7 8
    ! do: start, run 0.5, stop, run 0.1
    ! state: error
    PROC stopped()
        RAISE 7;
    ERROR
        RAISE;
    ENDPROC
    PROC main()
        WaitTime 9;
    ERROR
        TPWrite ValToStr(ERRNO);
        TRYNEXT;
    ENDPROC
ENDMODULE
