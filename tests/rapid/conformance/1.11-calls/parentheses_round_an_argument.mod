! rule: an argument may be in parentheses
! source: [K §3.10, 4.5]
MODULE Demo
    PROC main()
        TPWrite ("x");
        WaitTime (1);
    ENDPROC
ENDMODULE
