MODULE missing
    ! source: what nothing here stands behind is said, and stops the task where it is reached
    ! expect: before
    ! fault: 40001 9
    VAR egmident id;

    PROC main()
        TPWrite "before";
        EGMActMove id, tool0.tframe;
        TPWrite "never";
    ENDPROC
ENDMODULE
