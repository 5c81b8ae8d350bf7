MODULE long_jump_out_of_event_routine
    ! source: [K §7.2] levels are left by long jumps
    ! hook: stopped STOP T_ROB1
    ! do: start, run 0.5, stop, start, run 0.1
    ! expect: 7
    PROC stopped()
        RAISE 7;
    ERROR
        RAISE;
    ENDPROC
    PROC main()
        WaitTime 9;
    ERROR (7)
        TPWrite ValToStr(ERRNO);
        TRYNEXT;
    ENDPROC
ENDMODULE
