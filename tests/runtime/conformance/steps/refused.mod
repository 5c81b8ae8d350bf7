MODULE refused
    ! source: [mem] no step in an emergency stop, back from nowhere, or in a handler
    ! do: e-stop, step
    ! refused: step
    ! do: reset-e-stop, motors-on, step back
    ! refused: step back
    ! do: start, run 1, stop, run 1, step
    ! refused: step
    ! do: start, run 9
    ! state: finished
    PROC main()
        RAISE 5;
    ERROR
        WaitTime 5;
        TRYNEXT;
    ENDPROC
ENDMODULE
