MODULE error_in_backward_handler
    ! source: [K §7.1] it is nobody's
    ! do: step over
    ! expect: work
    ! do: step back
    ! at: error
    ! do: start, run 1
    ! expect: next
    PROC main()
        work;
        TPWrite "next";
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC
    PROC work()
        TPWrite "work";
    BACKWARD
        RAISE 7;
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC
ENDMODULE
