MODULE wait_begins_anew
    ! source: [S4 overview 5-23] a stopped wait counts from its beginning again
    ! do: start, run 1.5, stop, run 1, start, run 1.9
    ! do: run 0.2
    ! expect: done
    PROC main()
        WaitTime 2;
        TPWrite "done";
    ENDPROC
ENDMODULE
