MODULE stop_takes_start_back
    ! source: [mem] a stop takes a start back that waits for PP to main
    ! do: start, run 0.1, pp-to-main, start, stop, run 1
    ! expect: main
    ! state: ready
    PROC main()
        TPWrite "main";
        WaitTime 9;
    ENDPROC
ENDMODULE
